// What a study of trust found: a line of trust.csv a random scene, solved as by default and beside
// it on meshes of another family with finer steps.
#pragma once

#include <string>
#include <vector>

#include "engine/core/words.h"
#include "engine/record/snapshot.h"

namespace gridshell::record {

/// How the default's answer stands beside the finer one.
enum class TrustClass {
  right,                 ///< the same states, within twice the estimate
  estimate_small,        ///< the same states, further apart than twice the estimate
  other_branch,          ///< another state, and no event was told: silently wrong
  after_snap,            ///< another state after a snap that was told
  doubted,               ///< another state, and its leading meshes were told not to agree
  limited,               ///< both ended before their end, and said so
  limited_only_default,  ///< only the default did
  inner_unphysical,      ///< a frame that is no shell, and does not say so
  frame_dependent,       ///< another number of frames ended elsewhere
  refused,               ///< the scene was refused with a reason
  too_slow,              ///< stopped at the time limit
};
constexpr auto words(TrustClass) {
  return word_table<TrustClass>({{TrustClass::right, "right"},
                                 {TrustClass::estimate_small, "estimate_small"},
                                 {TrustClass::other_branch, "other_branch"},
                                 {TrustClass::after_snap, "after_snap"},
                                 {TrustClass::doubted, "doubted"},
                                 {TrustClass::limited, "limited"},
                                 {TrustClass::limited_only_default, "limited_only_default"},
                                 {TrustClass::inner_unphysical, "inner_unphysical"},
                                 {TrustClass::frame_dependent, "frame_dependent"},
                                 {TrustClass::refused, "refused"},
                                 {TrustClass::too_slow, "too_slow"}});
}

/// Whether a user would have been told something wrong without a word.
bool silently_wrong(TrustClass found);

/// One scene.
struct TrustRow {
  int scene = 0;
  std::string kind;  ///< "circle", "push", ...
  TrustClass found = TrustClass::right;
  double error =
      unknown;  ///< largest distance of a joint in a frame of both, over the length scale
  double estimate = unknown;  ///< what that frame said of it
  int exit_default = 0, exit_fine = 0;
  bool snap_default = false, snap_fine = false;  ///< whether a snap was told
  bool doubt = false;  ///< whether the default told that its leading meshes do not agree

  /// A snap that one family of meshes alone tells of.
  bool snap_alone() const {
    return exit_default == 0 && exit_fine == 0 && snap_default != snap_fine;
  }
};

/// The text of trust.csv; unknown numbers are empty.
std::string trust_csv(const std::vector<TrustRow>& rows);

}  // namespace gridshell::record
