#include "engine/simulate/frames_between.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/dense.h"
#include "engine/record/shape_measures.h"
#include "engine/simulate/frame_forces.h"
#include "engine/simulate/frame_joints.h"
#include "engine/simulate/frames.h"
#include "engine/simulate/indentation.h"
#include "engine/solve/equilibrium_path.h"

namespace gridshell::simulate {
namespace {

// largest error of a polynomial in t: over the tolerance, over the errors of the meshes, and over
// the largest curvature (for colours)
constexpr double fraction_of_tolerance = 0.1;
constexpr double fraction_of_errors = 0.5;
constexpr double fraction_of_colour = 5e-3;
constexpr std::size_t most_knots = 6;

bool smooth(const PathSegment& segment, std::size_t k) {
  return goes_on_between(segment, segment.load_steps[k], segment.load_steps[k + 1]);
}

}  // namespace

FramesBetween::FramesBetween(EquilibriumPath& path, const Watch& watch)
    : path_(path),
      watch_(watch),
      contacts_(parts_of(path.simulation.scene(), path.simulation.shell().finest())) {
  const Simulation& simulation = path.simulation;
  requested_ = simulation.shell().levels() > 1 && !simulation.scene().rods.contact.barrier.acts() &&
               strains_by_curvature(simulation.shell().model());
}

Eigen::VectorXd FramesBetween::curvature(const Eigen::Matrix3Xd& nodes) const {
  const Footprint& footprint = path_.simulation.scene().footprint;
  return cell_curvature(footprint,
                        joint_tangents(footprint, path_.simulation.shell().finest(), nodes));
}

/// The knot at a load step, or at a quarter between two of them; null: there is no stable state.
const FramesBetween::Knot* FramesBetween::knot_at(const PathSegment& segment, std::size_t quarter) {
  const auto [at, is_new] = known_.try_emplace(quarter);
  if (is_new) {
    Simulation& simulation = path_.simulation;
    const NestedShell& shell = simulation.shell();
    const LoadStep* a = &segment.load_steps[quarter / 4];
    const LoadStep* b = quarter % 4 == 0 ? nullptr : a + 1;
    const double part = double(quarter % 4) / 4,
                 t = b ? (1 - part) * a->point.t + part * b->point.t : a->point.t;
    const Report report = simulation.sample(t, *a, false, watch_, b);
    if (report.end == Outcome::reached && report.certificate.stable()) {
      Knot knot{shell.point(), frame_of(simulation)};
      put_push(path_, knot.frame, t, false);
      const Eigen::Matrix3Xd own = nodes_of(shell.finest(), shell.model(), knot.point.state.x);
      knot.frame.nodes -= own.leftCols(knot.frame.nodes.cols());
      knot.frame.cell_K -= curvature(own);
      at->second = std::move(knot);
    }
  }
  return at->second ? &*at->second : nullptr;
}

std::optional<FramesBetween::Window> FramesBetween::window_at(const PathSegment& segment,
                                                              double t) {
  const auto& steps = segment.load_steps;
  const double sign = segment.sign();
  std::size_t k = 0;
  while (k + 2 < steps.size() && sign * (steps[k + 1].point.t - t) <= 0) ++k;
  if (steps.size() < 2 || !(sign * (t - steps[k].point.t) > 0) ||
      !(sign * (steps[k + 1].point.t - t) > 0) || !smooth(segment, k))
    return {};
  std::size_t first = k, last = k + 1;
  for (std::size_t size = 0; size != last - first;) {
    size = last - first;
    if (first > 0 && size + 1 < most_knots && smooth(segment, first - 1)) --first;
    if (last + 1 < steps.size() && last - first + 1 < most_knots && smooth(segment, last)) ++last;
  }
  return Window{k, first, last};
}

/// The knots from quarter `first` to `last`, each `by` from the one before it; empty if there is no
/// stable state at one of them.
FramesBetween::Knots FramesBetween::knots_in(const PathSegment& segment, std::size_t first,
                                             std::size_t last, std::size_t by) {
  Knots knots;
  for (std::size_t quarter = first; quarter <= last; quarter += by) {
    knots.push_back(knot_at(segment, quarter));
    if (!knots.back()) return {};
  }
  return knots;
}

/// Nodes of the finest mesh, interpolated through the four nearest states.
std::optional<Eigen::Matrix3Xd> FramesBetween::nodes_at(double t, const Knots& knots,
                                                        double& doubt_mm) const {
  const NestedShell& shell = path_.simulation.shell();
  std::vector<const PathPoint*> points;
  for (const Knot* knot : knots)
    if (knot->point.velocity.x.size() > 0) points.push_back(&knot->point);
  std::ranges::stable_sort(points, {}, [t](const PathPoint* p) { return std::abs(p->t - t); });
  if (points.size() > 4) points.resize(4);
  if (points.size() < 3) return {};
  const Eigen::Index nodes = shell.finest().rod_nodes();
  const State all = gridshell::between(shell.model(), points, t);
  points.pop_back();
  const State fewer = gridshell::between(shell.model(), points, t);
  doubt_mm = 4 * max_column_norm((all.x - fewer.x).leftCols(nodes));
  return nodes_of(shell.finest(), shell.model(), all.x);
}

std::optional<record::Frame> FramesBetween::at(const PathSample& sample) {
  const PathSegment& segment = path_.segments[sample.segment];
  if (std::exchange(segment_, sample.segment) != sample.segment) known_.clear();
  const auto window = requested_ ? window_at(segment, sample.t) : std::nullopt;
  if (!window) return {};
  const std::size_t before = 4 * window->before, first = 4 * window->first, last = 4 * window->last;
  // earlier knots are no longer needed; a segment back is shown in reverse
  std::erase_if(known_, [&](const auto& known) {
    return segment.back ? known.first > last + 3 : known.first < first;
  });
  auto frame = between(sample.t, knots_in(segment, first, last, 4));
  if (!frame) frame = between(sample.t, knots_in(segment, before, before + 4, 1));
  if (frame) put_push(path_, *frame, sample.t, true);
  return frame;
}

/// The frame interpolated at t; empty if its estimated error is larger than allowed.
std::optional<record::Frame> FramesBetween::between(double t, const Knots& knots) const {
  using record::Frame;
  if (knots.size() < 3) return {};
  const Scene& scene = path_.simulation.scene();
  const double fraction = fraction_of_tolerance * scene.tolerance,
               allowed_mm = fraction * scene.length_scale_mm;
  double nodes_mm = 0;
  const auto nodes = nodes_at(t, knots, nodes_mm);
  if (!nodes || !(nodes_mm <= allowed_mm)) return {};

  std::vector<double> known;
  for (const Knot* knot : knots) known.push_back(knot->point.t);
  const Eigen::VectorXd all = polynomial_weights(known, t);
  const Weights weights{all,
                        {all - polynomial_weights(known, t, 0),
                         all - polynomial_weights(known, t, known.size() - 1)}};
  const auto sum = [&](const Eigen::VectorXd& w, auto member) {
    std::decay_t<decltype(knots[0]->frame.*member)> total = w[0] * (knots[0]->frame.*member);
    for (std::size_t k = 1; k < knots.size(); ++k)
      total += w[Eigen::Index(k)] * (knots[k]->frame.*member);
    return total;
  };
  const auto doubt = [&](auto member, const auto& size) {
    return 2 *
           std::max(size(sum(weights.without[0], member)), size(sum(weights.without[1], member)));
  };
  const auto largest = [](const auto& values) {
    return values.size() > 0 ? values.cwiseAbs().maxCoeff() : 0.0;
  };
  const auto of_energies = [](const Energies& energies) {
    double most = std::abs(energies.total());
    for (const TermName& term : energy_terms) most = std::max(most, std::abs(energies[term.term]));
    return most;
  };
  // the load steps around it
  std::size_t after = 1;
  while (after + 1 < knots.size() && (known[after] - t) * (known[0] - t) > 0) ++after;
  const Frame &a = knots[after - 1]->frame, &b = knots[after]->frame;
  const double part = (t - known[after - 1]) / (known[after] - known[after - 1]);
  const auto around = [&](double Frame::*member) {
    return (1 - part) * a.*member + part * b.*member;
  };

  Frame frame;
  frame.kind = "interpolated";
  frame.nodes = sum(weights.all, &Frame::nodes);
  frame.energies = sum(weights.all, &Frame::energies);
  frame.reactions_N = sum(weights.all, &Frame::reactions_N);
  nodes_mm += doubt(&Frame::nodes, [](const auto& x) { return max_column_norm(x); });
  const double mJ = doubt(&Frame::energies, of_energies), N = doubt(&Frame::reactions_N, largest);
  // an error below those of the meshes does not count
  const auto seen = [&](double off, double size, double Frame::*error) {
    return !(off <= std::max(fraction * size, fraction_of_errors * around(error)));
  };
  const double curved = largest(sum(weights.all, &Frame::curvature_per_mm));
  if (!(nodes_mm <= allowed_mm) ||
      !(doubt(&Frame::curvature_per_mm, largest) <= fraction_of_colour * curved) ||
      seen(mJ, of_energies(frame.energies), &Frame::energy_error_mJ) ||
      seen(N, largest(frame.reactions_N), &Frame::force_error_N))
    return {};
  frame.nodes += nodes->leftCols(frame.nodes.cols());
  frame.cell_K = curvature(*nodes) + sum(weights.all, &Frame::cell_K);
  // a load step without a load has no column
  for (std::size_t k = 0; k < knots.size(); ++k) {
    const Eigen::Matrix3Xd& at_knot = knots[k]->frame.loads_N;
    if (at_knot.cols() == 0) continue;
    if (frame.loads_N.cols() == 0) frame.loads_N.setZero(3, at_knot.cols());
    frame.loads_N += weights.all[Eigen::Index(k)] * at_knot;
  }
  frame.axial_force_N = sum(weights.all, &Frame::axial_force_N);
  frame.brace_force_N = sum(weights.all, &Frame::brace_force_N);
  frame.bending_mJ_per_m = sum(weights.all, &Frame::bending_mJ_per_m).cwiseMax(0);
  frame.curvature_per_mm = sum(weights.all, &Frame::curvature_per_mm).cwiseMax(0);
  frame.angle_deg = sum(weights.all, &Frame::angle_deg);
  frame.torque_Nmm = sum(weights.all, &Frame::torque_Nmm);
  frame.joint_angle_error_deg = around(&Frame::joint_angle_error_deg);
  frame.one_angle_error_deg = around(&Frame::one_angle_error_deg);
  frame.joint_torque_error_Nmm = around(&Frame::joint_torque_error_Nmm);
  frame.springs_error_mJ = around(&Frame::springs_error_mJ) + mJ;
  put_joint_ranges(frame);
  frame.stiffness_N_per_mm = sum(weights.all, &Frame::stiffness_N_per_mm);
  frame.residual_N = record::unknown;
  frame.negative_pivots = 0;
  frame.error_estimate_mm = around(&Frame::error_estimate_mm) + nodes_mm;
  frame.force_error_N = around(&Frame::force_error_N) + N;
  frame.push_error_N = around(&Frame::push_error_N) + N;
  frame.energy_error_mJ = around(&Frame::energy_error_mJ) + mJ;
  frame.stiffness_error_N_per_mm =
      around(&Frame::stiffness_error_N_per_mm) +
      doubt(&Frame::stiffness_N_per_mm, [](double value) { return std::abs(value); });
  complete_shape(path_.simulation, contacts_.in(frame.nodes), frame);
  return frame;
}

}  // namespace gridshell::simulate
