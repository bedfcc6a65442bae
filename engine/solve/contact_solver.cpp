// Blocks beyond a model's pattern, between edges that come near each other: a pattern with theirs
// and a solver planned for it.
#include "engine/solve/linear_solver.h"

namespace gridshell {
namespace {

class ContactSolver final : public LinearSolver {
 public:
  explicit ContactSolver(const Model& model)
      : model_(model), touching_(model), apart_(make_pattern_solver(model)) {}

  Inertia factor(const BlockHessian& hessian, double shift) override {
    current_ = apart_.get();
    if (!hessian.beyond.empty()) {
      if (!together_ || !known(hessian)) plan(hessian);
      current_ = together_.get();
    }
    current_->most_negative = most_negative;
    current_->team = team;
    return current_->factor(hessian.beyond.empty() ? hessian : merged(hessian), shift);
  }
  void solve(Eigen::Matrix3Xd& right_hand_side) const override { current_->solve(right_hand_side); }
  long long blocks() const override { return current_->blocks(); }

 private:
  bool known(const BlockHessian& hessian) const {
    return std::ranges::all_of(hessian.beyond, [&](const BlockHessian::Beyond& one) {
      return touching_.pattern.find(one.row, one.column) >= 0;
    });
  }
  void plan(const BlockHessian& hessian) {
    touching_.pattern = model_.pattern;
    for (const BlockHessian::Beyond& one : hessian.beyond)
      touching_.pattern.slot(one.row, one.column);
    together_ = make_pattern_solver(touching_);
  }
  /// The same with all blocks in the pattern.
  const BlockHessian& merged(const BlockHessian& hessian) {
    merged_.diagonal = hessian.diagonal;
    merged_.pair = hessian.pair;
    merged_.pair.resize(touching_.pattern.pairs().size());
    for (const BlockHessian::Beyond& one : hessian.beyond)
      merged_.add(touching_.pattern.find(one.row, one.column), one.block);
    return merged_;
  }

  const Model& model_;
  Model touching_;  // its pattern has the blocks beyond
  std::unique_ptr<LinearSolver> apart_, together_;
  LinearSolver* current_ = apart_.get();
  BlockHessian merged_;
};

}  // namespace

std::unique_ptr<LinearSolver> make_contact_solver(const Model& model) {
  return std::make_unique<ContactSolver>(model);
}

}  // namespace gridshell
