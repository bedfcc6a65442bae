// A shell on which tests execute commands, without a window and without a thread.
#pragma once

#include <catch2/catch.hpp>

#include "app/window/edit_session.h"
#include "tests/presets.h"

namespace gridshell::window {

struct EditedShell {
  EditSession session;

  explicit EditedShell(const preset::Preset& preset = small_shell(),
                       std::int64_t most_bytes = std::int64_t(100) << 20)
      : session(most_bytes) {
    act(Open{preset});
    refine();
  }

  const ShellView& view() const { return session.shell(); }
  const Eigen::Matrix3Xd& nodes() const { return view().frame.nodes; }
  Eigen::Vector3d node(int k) const { return nodes().col(k); }
  double bending_mJ() const { return view().frame.energies[Term::bend]; }
  int joint(int i, int j) const {
    for (const record::Joint& joint : view().layout->joints)
      if (joint.i == i && joint.j == j) return joint.node;
    return -1;
  }

  /// Executes a command and returns its error, which is empty if it succeeded.
  std::string attempt(const Edit& edit) {
    session.execute({edit}, unwatched);
    return view().error;
  }
  void act(const Edit& edit) { REQUIRE(attempt(edit) == ""); }
  void drag(const Edit& edit, int drag) {
    session.execute({edit, drag, true}, unwatched);
    REQUIRE(view().error == "");
  }
  void end_drag(int drag) {
    session.execute({RefineAfterDrag{}, drag, false}, unwatched);
    refine();
  }
  void refine() {
    session.refine(unwatched);
    REQUIRE(view().error == "");
  }
};

/// The largest displacement of a node from an earlier state.
inline double difference(const EditedShell& now, const ShellView& then) {
  return (now.nodes() - then.frame.nodes).cwiseAbs().maxCoeff();
}

}  // namespace gridshell::window
