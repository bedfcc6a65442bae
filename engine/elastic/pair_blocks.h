// Where the Hessians of energies of two edges go.
#pragma once

#include "engine/elastic/model.h"

namespace gridshell {

/// m stands at (a, b) and transposed at (b, a)
inline void add_block(int a, int b, BlockSlot slot, const Eigen::Matrix3d& m, BlockHessian& h) {
  if (a == b)
    h.diagonal[std::size_t(a)].matrix() += m + m.transpose();
  else
    h.add(slot, m);
}

/// An edge vector's own stiffness at its two nodes.
inline void add_edge_block(const ModelEdge& edge, const Eigen::Matrix3d& m, BlockHessian& h) {
  h.diagonal[std::size_t(edge.from)].matrix() += m;
  h.diagonal[std::size_t(edge.to)].matrix() += m;
  h.add(edge.slot, -m);
}

template <class Law>
void add_spin_hessian(const Model& model, const Pair<Law>& pair, const PairMatrix& H,
                      BlockHessian& h) {
  const int place[2] = {model.spin[std::size_t(pair.e)], model.spin[std::size_t(pair.f)]};
  const double scale = 1 / model.spin_length;
  for (int k = 0; k < 2; ++k)
    for (int end = 0; end < 4; ++end) {
      const double side = end % 2 == 0 ? -scale : scale;
      Eigen::Matrix3d block = Eigen::Matrix3d::Zero();
      block.col(place[k] % 3) = side * H.block<3, 1>(end < 2 ? 0 : 3, 6 + k);
      h.add(pair.slots.spin[end][k], block);
    }
  for (int k = 0; k < 2; ++k)
    h.diagonal[std::size_t(place[k] / 3)].matrix()(place[k] % 3, place[k] % 3) +=
        scale * scale * H(6 + k, 6 + k);
  const double across = scale * scale * H(6, 7);
  if (place[0] / 3 == place[1] / 3) {
    auto own = h.diagonal[std::size_t(place[0] / 3)].matrix();
    own(place[0] % 3, place[1] % 3) += across;
    own(place[1] % 3, place[0] % 3) += across;
  } else {
    h.add_entry(pair.slots.spins, place[0] % 3, place[1] % 3, across);
  }
}

template <class Law>
void add_pair_hessian(const Model& model, const Pair<Law>& pair, const PairMatrix& H,
                      BlockHessian& h) {
  const ModelEdge &e = model.edges[std::size_t(pair.e)], &f = model.edges[std::size_t(pair.f)];
  add_edge_block(e, H.block<3, 3>(0, 0), h);
  add_edge_block(f, H.block<3, 3>(3, 3), h);
  const Eigen::Matrix3d ef = H.block<3, 3>(0, 3);
  const int of_e[2] = {e.from, e.to}, of_f[2] = {f.from, f.to};
  for (int a = 0; a < 2; ++a)
    for (int b = 0; b < 2; ++b)
      add_block(of_e[a], of_f[b], pair.slots.across[a][b], a == b ? ef : Eigen::Matrix3d(-ef), h);
  if (model.has_spins()) add_spin_hessian(model, pair, H, h);
}

}  // namespace gridshell
