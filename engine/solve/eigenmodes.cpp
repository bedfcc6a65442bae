#include "engine/solve/eigenmodes.h"

#include <Spectra/SymEigsSolver.h>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "engine/core/try.h"

namespace gridshell {
namespace {

using Eigen::Index;

/// Eigenvectors as columns, the largest eigenvalue in size first.
struct Pairs {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};

struct Stopped {};

/// The operator M^1/2 K^-1 M^1/2 on vectors orthogonal to those found before, as Spectra expects
/// it.
class DeflatedInverse {
 public:
  using Scalar = double;
  DeflatedInverse(const Linearisation& system, const Eigen::Matrix3Xd& root,
                  const Eigen::MatrixXd& found, const Watch& watch)
      : system_(system), root_(root), found_(found), watch_(watch) {}

  Index rows() const { return root_.size(); }
  Index cols() const { return root_.size(); }
  void perform_op(const double* in, double* out) const {
    // only an exception ends an iteration of Spectra
    if (watch_.cancelled()) throw Stopped{};
    Eigen::VectorXd x = Eigen::Map<const Eigen::VectorXd>(in, rows());
    take_out(x);
    Eigen::Matrix3Xd y = root_.cwiseProduct(x.reshaped(3, root_.cols()));
    system_.solve(y);
    x = root_.cwiseProduct(y).reshaped();
    take_out(x);
    Eigen::Map<Eigen::VectorXd>(out, rows()) = x;
  }

 private:
  void take_out(Eigen::VectorXd& x) const {
    if (found_.cols() > 0) x -= found_ * (found_.transpose() * x);
  }

  const Linearisation& system_;
  const Eigen::Matrix3Xd& root_;
  const Eigen::MatrixXd& found_;
  const Watch& watch_;
};

/// Appends the pairs that another run finds in addition to the `count` largest present ones, of the
/// sign given by `rule`. Returns whether it found any. If a run converges only some of its pairs,
/// as near a mode of almost no stiffness, the next run finds the others. Errors: as
/// softest_modes().
Result<bool> extend(const DeflatedInverse& inverse, Spectra::SortRule rule, Index count, Index ask,
                    Pairs& found) {
  constexpr int most_restarts = 100;
  constexpr double converged = 1e-8, more = 1 + 1e-9, round_off = 1e-13;
  const double sign = rule == Spectra::SortRule::LargestAlge ? 1 : -1;
  const Index space = std::min(inverse.rows(), std::max<Index>(2 * ask + 8, 20));
  Pairs next;
  try {
    Spectra::SymEigsSolver solver(const_cast<DeflatedInverse&>(inverse), ask, space);
    solver.init();
    solver.compute(rule, most_restarts, converged, rule);
    next = {solver.eigenvalues(), solver.eigenvectors()};
  } catch (const Stopped&) {
    return stopped();
  } catch (const std::runtime_error&) {
    // Spectra throws this for values that are not finite
  }
  if (next.values.size() == 0)
    return fail(Fault::no_equilibrium, "the lowest modes of the state do not converge");
  const Index known = found.values.size();
  const double least = known < count ? round_off * next.values.cwiseAbs().maxCoeff()
                                     : std::abs(found.values[count - 1]) * more;
  Index taken = 0;
  while (taken < next.values.size() && sign * next.values[taken] > least) ++taken;
  if (taken == 0) return false;
  // known and new pairs together, in order
  Eigen::VectorXd values(known + taken);
  values << found.values, next.values.head(taken);
  std::vector<Index> order(std::size_t(values.size()));
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = Index(k);
  std::ranges::stable_sort(
      order, [&](Index a, Index b) { return std::abs(values[a]) > std::abs(values[b]); });
  Eigen::MatrixXd vectors(inverse.rows(), values.size());
  vectors << found.vectors, next.vectors.leftCols(taken);
  found = {values(order), vectors(Eigen::all, order)};
  return true;
}

/// Computes the `count` eigenvalues of largest size among the `all` that have the sign of `rule`.
Result<Pairs> largest(const Linearisation& system, const Eigen::Matrix3Xd& root, Index count,
                      Index all, Spectra::SortRule rule, const Watch& watch) {
  constexpr Index a_few = 4;  // eigenvalues that a run may have missed
  Pairs found{Eigen::VectorXd(0), Eigen::MatrixXd(root.size(), 0)};
  // whether there are equal eigenvalues does not matter if one mode is requested
  const Index runs = count > 1 ? all : count;
  for (Index ask = count, run = 0; run < runs && found.values.size() < all; ask = a_few, ++run) {
    const DeflatedInverse inverse(system, root, found.vectors, watch);
    TRY(grew, extend(inverse, rule, count,
                     std::min({ask, all - found.values.size(), root.size() - 1}), found));
    if (!*grew) break;
  }
  const Index kept = std::min(count, found.values.size());
  return Pairs{found.values.head(kept), found.vectors.leftCols(kept)};
}

}  // namespace

Result<Eigenmodes> softest_modes(const Linearisation& system, const Eigen::Matrix3Xd& mass,
                                 int count, int negative, const Watch& watch) {
  const Model& model = system.model();
  Eigen::Matrix3Xd root = mass.cwiseSqrt();
  clear_fixed(model, root);
  const Index massive = (root.array() > 0).count();
  const double unit = root.squaredNorm() / double(massive);
  root /= std::sqrt(unit);
  const Index below = std::min(count, negative), above = std::min<Index>(count, massive) - below;
  TRY(soft, largest(system, root, below, negative, Spectra::SortRule::SmallestAlge, watch));
  TRY(stiff,
      largest(system, root, above, massive - negative, Spectra::SortRule::LargestAlge, watch));
  Eigenmodes modes;
  modes.values.resize(soft->values.size() + stiff->values.size());
  const auto put = [&](double inverse, const auto& vector) {
    const double lambda = 1 / (inverse * unit);
    // lambda K^-1 M maps a mode to itself and computes its unknowns without mass
    Eigen::Matrix3Xd shape = root.cwiseProduct(vector.reshaped(3, root.cols())), force;
    system.solve(shape);
    shape *= lambda * std::sqrt(unit);
    // Rayleigh's quotient without the shift that bears directions without stiffness
    modes.values[Index(modes.shapes.size())] =
        lambda - system.neutral_shift() * shape.squaredNorm();
    multiply(model, system.assembly().hessian, shape, force);
    force += system.neutral_shift() * shape;
    Eigen::Matrix3Xd inertia = lambda * mass.cwiseProduct(shape);
    for (Eigen::Matrix3Xd* of : {&force, &inertia}) {
      clear_fixed(model, *of);
      for (const Constraint& constraint : system.constraints())
        of->col(constraint.node) -= constraint.part(of->col(constraint.node));
    }
    modes.residuals.push_back((force - inertia).norm() / inertia.norm());
    modes.shapes.push_back(std::move(shape));
  };
  // of the negative ones, the inverse nearest to zero belongs to the lowest eigenvalue
  for (Index k = soft->values.size(); k-- > 0;) put(soft->values[k], soft->vectors.col(k));
  for (Index k = 0; k < stiff->values.size(); ++k) put(stiff->values[k], stiff->vectors.col(k));
  return modes;
}

}  // namespace gridshell
