// What makes a formed shell stiff and what it carries then: bolts, braces, load cases.
#pragma once

#include <string>

#include "engine/preset/preset.h"
#include "engine/simulate/simulation.h"

namespace gridshell::simulate {

struct StepPath;

/// All joints keep the angles that they have. Errors (bad_input): a shell that is flat yet.
Result<Report> tighten(Simulation& simulation, const preset::Step& step, const Watch& watch);

/// Bolts in the joints strive for other angles, evenly along a path: each is a spring at the joint
/// that is tightened where the joint stands, and whose angle of rest goes to the step's. Errors
/// (bad_input): a flat shell, a joint where not two rods cross, an angle that no joint has, bolts
/// of another stiffness.
Result<Report> open(Simulation& simulation, const preset::Step& step, const Watch& watch,
                    StepPath* way);

/// What joints that were opened came to: "joints at 62.1 degrees on average, ...".
std::string text_of_opened(const Simulation& simulation);

/// Diagonals come into cells, as long as these are now. Errors (bad_input): a cell that is not
/// there, a flat shell.
Result<Report> brace(Simulation& simulation, const preset::Step& step, const Watch& watch);

/// All bolts or braces go again, and the shell goes to the rest beside. Errors (bad_input): there
/// are none.
Result<Report> take_out(Simulation& simulation, preset::Released what, const Watch& watch);

/// From now on the scene's load case of that name acts `factor` times. Errors (bad_input): there is
/// no such case.
Result<Report> bring_case(Simulation& simulation, const std::string& name, double factor,
                          const Watch& watch);

}  // namespace gridshell::simulate
