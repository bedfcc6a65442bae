// What is measured on a state: its certificate on finer meshes, its symmetry, modes and life.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "engine/record/frame.h"
#include "engine/record/shape_symmetry.h"
#include "engine/record/states.h"
#include "engine/simulate/shell_symmetry.h"
#include "engine/simulate/simulation.h"

namespace gridshell::study {

using simulate::symmetries_of_shell;

/// The meshes that the accuracy asks for, but two at least, of which energies are extrapolated.
LevelPlan measuring_plan(const Scene& scene);

/// A state that a shell can rest in at the end of its actuation.
struct ShellState {
  record::StateRow row;  ///< what is measured, and how often trials ended in it
  record::Frame frame;   ///< extrapolated as planned, upright where up and down are alike
  State rest;            ///< on the mesh that states are judged on
  double energy_mJ = 0;  ///< there, as it was met
  Effort effort = {};    ///< of its measures
};

/// Measures states, one after another; one a thread.
class StateMeasures {
 public:
  /// `tolerance_mm`: joints that a symmetry moves by less stay where they are. Errors (bad_input):
  /// rods that the rung cannot take.
  static Result<StateMeasures> make(std::shared_ptr<const Scene> scene, double tolerance_mm);

  /// A state as it was met, with its measures but its number; nothing where finer meshes do not
  /// have it, have it and it is not stable, or its rods are beyond the strain allowed.
  std::optional<ShellState> of(const ShellState& met, bool life, const Watch& watch);

  const Simulation& session() const { return session_; }
  /// Of the finest mesh, and so of its joints.
  const std::vector<MeshSymmetry>& symmetries() const { return fine_; }

 private:
  StateMeasures(std::shared_ptr<const Scene> scene, double tolerance_mm, Simulation session,
                Simulation path);
  State upright(const State& rest) const;
  void put_life(const State& rest, record::StateRow& row, const Watch& watch);
  double eigenvalue(const Watch& watch);

  std::shared_ptr<const Scene> scene_;
  double tolerance_mm_;
  Simulation session_, path_;  // on all meshes, and on the coarsest alone
  std::vector<MeshSymmetry> coarse_, fine_;
};

}  // namespace gridshell::study
