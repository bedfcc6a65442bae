// The potential energy of a shell by term: one list for solver, frames, columns and summary.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "engine/core/algorithms.h"
#include "engine/core/enum_words.h"

namespace gridshell {

/// Terms of a shell's energy. A new term needs an enumerator, a line in `energy_terms` and its
/// energy.
enum class Term { bend, stretch, twist, joint, shear, load, support, contact };

/// Name of a term, as in `energy_bend_mJ`, and its meaning.
struct TermName {
  Term term;
  const char* name;
  const char* meaning;
};

inline constexpr std::array energy_terms{
    TermName{Term::bend, "bend", "bending of the rods"},
    TermName{Term::stretch, "stretch", "stretching of the rods and of braces"},
    TermName{Term::twist, "twist", "torsion of the rods"},
    TermName{Term::joint, "joint", "springs of the joints, and the twist that they pass"},
    TermName{Term::shear, "shear", "resistance of the joints to shear"},
    TermName{Term::load, "load", "minus the work of loads, and the energy of the ground"},
    TermName{Term::support, "support", "springs of the supports"},
    TermName{Term::contact, "contact", "barriers between rods that are near each other"},
};

static_assert(
    [] {
      for (std::size_t k = 0; k < energy_terms.size(); ++k)
        if (energy_terms[k].term != Term(k)) return false;
      return !is_enumerator<Term(energy_terms.size())>();
    }(),
    "every term has its line in energy_terms, in their order");

/// Millijoules by term. Sums, differences and multiples go term by term.
class Energies {
 public:
  static constexpr std::size_t size = energy_terms.size();

  double& operator[](Term term) { return mJ_[std::size_t(term)]; }
  double operator[](Term term) const { return mJ_[std::size_t(term)]; }

  /// The potential that an equilibrium minimises.
  double total() const {
    double sum = 0;
    for (double value : mJ_) sum += value;
    return sum;
  }

  Energies& operator+=(const Energies& other) {
    for (std::size_t k = 0; k < size; ++k) mJ_[k] += other.mJ_[k];
    return *this;
  }
  Energies& operator*=(double factor) {
    for (double& value : mJ_) value *= factor;
    return *this;
  }
  friend Energies operator+(Energies a, const Energies& b) { return a += b; }
  friend Energies operator-(Energies a, const Energies& b) { return a += -1 * b; }
  friend Energies operator*(double factor, Energies a) { return a *= factor; }
  friend Energies operator/(Energies a, double divisor) {
    for (double& value : a.mJ_) value /= divisor;
    return a;
  }
  friend bool operator==(const Energies&, const Energies&) = default;

  /// Energies that are not known: all NaN.
  static Energies not_known() {
    Energies energies;
    energies.mJ_.fill(std::numeric_limits<double>::quiet_NaN());
    return energies;
  }

 private:
  std::array<double, size> mJ_{};
};

/// Energies extrapolated by richardson(). If the result is below 0 for a term that cannot be
/// negative, the term vanishes with the mesh: it is then the square of an extrapolated stress.
inline Energies extrapolated(const Energies& fine, const Energies& coarse) {
  Energies energies = richardson(fine, coarse);
  for (const auto& [term, name, meaning] : energy_terms) {
    if (term == Term::load || energies[term] >= 0 || !(fine[term] >= 0)) continue;
    energies[term] = std::pow(richardson(std::sqrt(fine[term]), std::sqrt(coarse[term])), 2);
  }
  return energies;
}

}  // namespace gridshell
