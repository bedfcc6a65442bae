#include "engine/solve/linear_solver.h"

#include <cmath>
#include <optional>

#include "engine/elastic/model.h"
#include "engine/solve/block_factor.h"

namespace gridshell {
namespace {

/// Solver for Hessians with blocks outside the model's pattern, between edges that are close or
/// nodes of a face, for which it plans a factorisation of the extended pattern. It takes the
/// Hessian's matrix of rank one into account, too.
class ExtraBlockSolver final : public LinearSolver {
 public:
  explicit ExtraBlockSolver(const Model& model)
      : model_(model), apart_(make_block_cholesky(model)) {}

  Inertia factor(const BlockHessian& hessian, double shift) override {
    if (!apart_) apart_ = make_block_cholesky(model_);
    if (!numbers) numbers = std::make_shared<FactorNumbers>();
    current_ = apart_.get();
    if (!hessian.extra.empty()) {
      if (!together_ || !known(hessian)) plan(hessian);
      current_ = together_.get();
    }
    const bool joined = hessian.rank_one.cols() > 0;
    // the matrix of rank one may reduce the number of negative eigenvalues by one
    current_->most_negative = most_negative + (joined && most_negative < 1000000);
    current_->team = team;
    current_->numbers = numbers;
    Inertia inertia = current_->factor(hessian.extra.empty() ? hessian : merged(hessian), shift);
    rank_one_ = hessian.rank_one;
    if (joined && inertia.usable && inertia.negative_pivots <= current_->most_negative)
      join(inertia);
    return inertia;
  }
  void solve(Eigen::Matrix3Xd& right_hand_side) const override {
    if (!current_) return void(right_hand_side.setZero());
    current_->solve(right_hand_side);
    if (rank_one_.cols() > 0)
      right_hand_side -= rank_one_.cwiseProduct(right_hand_side).sum() / schur_ * response_;
  }
  bool has_factor() const override { return current_ && current_->has_factor(); }
  void free_memory() override {
    current_ = nullptr;
    apart_.reset();
    together_.reset();
    wider_.reset();
    merged_ = {};
    rank_one_.resize(3, 0);
    if (numbers) *numbers = {};
  }
  long long blocks() const override { return current_ ? current_->blocks() : 0; }

 private:
  /// K + c c^T by the factor of K [Sherman, Morrison 1950]: with w = K^-1 c and s = 1 + c.w a
  /// solution x becomes x - w (c.x)/s; if s < 0, the sum has one negative eigenvalue less than K.
  void join(Inertia& inertia) {
    response_ = rank_one_;
    current_->solve(response_);
    schur_ = 1 + rank_one_.cwiseProduct(response_).sum();
    inertia.usable = std::isfinite(schur_) && schur_ != 0;
    inertia.negative_pivots -= schur_ < 0;
  }
  bool known(const BlockHessian& hessian) const {
    return std::ranges::all_of(hessian.extra, [&](const BlockHessian::Extra& one) {
      return wider_->pattern.find(one.row, one.column) >= 0;
    });
  }
  void plan(const BlockHessian& hessian) {
    wider_ = model_;
    for (const BlockHessian::Extra& one : hessian.extra) wider_->pattern.slot(one.row, one.column);
    together_ = make_block_cholesky(*wider_);
  }
  /// The Hessian with all blocks in the pattern.
  const BlockHessian& merged(const BlockHessian& hessian) {
    merged_.diagonal = hessian.diagonal;
    merged_.pair = hessian.pair;
    merged_.pair.resize(wider_->pattern.pairs().size());
    for (const BlockHessian::Extra& one : hessian.extra)
      merged_.add(wider_->pattern.find(one.row, one.column), one.block);
    return merged_;
  }

  const Model& model_;
  std::optional<Model> wider_;  // its pattern includes the additional blocks
  std::unique_ptr<LinearSolver> apart_, together_;
  LinearSolver* current_ = apart_.get();
  BlockHessian merged_;
  Eigen::Matrix3Xd rank_one_, response_;
  double schur_ = 1;
};

}  // namespace

std::unique_ptr<LinearSolver> make_linear_solver(const Model& model) {
  return std::make_unique<ExtraBlockSolver>(model);
}

Eigen::Matrix3d without_fixed(const Model& model, int row, int column,
                              const Eigen::Matrix3d& block) {
  Eigen::Matrix3d m = block;
  for (int k = 0; k < 3; ++k) {
    if (model.fixed[std::size_t(row)] >> k & 1) m.row(k).setZero();
    if (model.fixed[std::size_t(column)] >> k & 1) m.col(k).setZero();
    if (row == column && model.fixed[std::size_t(row)] >> k & 1) m(k, k) = 1;
  }
  return m;
}

}  // namespace gridshell
