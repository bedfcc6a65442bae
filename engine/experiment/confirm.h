// What happens on a path belongs to the shell, not to the mesh that led: it is looked for on a
// finer leader too.
#pragma once

#include "engine/experiment/course.h"

namespace gridshell::experiment {

/// Whether two courses on different meshes tell the same: the same legs with the same events, which
/// lie near each other, to the same end. Otherwise a sentence says what they differ in.
std::optional<std::string> disagreement(const Course& coarse, const Course& fine);

/// A course that began in a buckled state out of the flat, or on which something happened, followed
/// once more with leading meshes of twice the edges.
/// Where both tell the same, the events' places are extrapolated (the error falls fourfold), with
/// an error, and where the path turns back clearly later with the finer one, its course is kept;
/// where they do not, the finer one is asked against a still finer one, at most three
/// times. Where a leader was asked for, its course is kept, and what a finer one does not confirm
/// is said. What remains in doubt is said. Errors: cancelled.
Result<Course> confirmed(const Scene& scene, Course course, const Follow& follow,
                         const Watch& watch);

}  // namespace gridshell::experiment
