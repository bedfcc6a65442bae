// The runs that only the maps make: what is tried in a cell, beside the methods of method.h.
#pragma once

#include "engine/study/method.h"
#include "engine/study/subject.h"

namespace gridshell::study {

/// As an experiment runs it, through `stops` certified states: on the meshes of `plan`, and where
/// `tolerance` is above 0 on finer ones until the estimate meets it.
Arrival by_default(Subject& study, LevelPlan plan, double tolerance, int stops, const Watch& watch);

/// Off the equilibrium by 0.01 mm, then a fixed number of explicit steps.
Arrival hold(const Problem& problem, double over_l_c, const Watch& watch);

/// The path from the flat with a dome on it to the study's start, as a problem of its own.
Problem from_flat(const Subject& study, const Problem& problem, double height);

/// The first buckled state, as the engine finds it.
Arrival buckle(const Subject& study, const Problem& problem, const Watch& watch);

}  // namespace gridshell::study
