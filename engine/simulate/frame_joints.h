// Angles and torques of joints with laws or springs in frames.
#pragma once

#include "engine/record/frame.h"
#include "engine/simulate/simulation.h"

namespace gridshell::simulate {

/// Writes the angles and torques of the current state's joints with laws or springs, extrapolated
/// where the energies are, their ranges and errors; nothing without such joints.
void put_joints(const Simulation& simulation, record::Frame& frame);

/// Writes mean, smallest and largest angle and the largest torque of a frame's joints.
void put_joint_ranges(record::Frame& frame);

/// Text on the crossing angles that a joint actuation reached: "joints at 62.1 degrees on average,
/// ...".
std::string text_of_joints(const record::Frame& frame);

}  // namespace gridshell::simulate
