// Networks of rods in files that a user brings.
#pragma once

#include <string>
#include <string_view>

#include "engine/core/result.h"
#include "engine/preset/points.h"

namespace gridshell::preset {

/// The largest file of a network that is read.
inline constexpr std::size_t largest_network_file = std::size_t(16) << 20;

/// Points of a file nearer to one another than this are one.
inline constexpr double one_point_mm = 1e-3;

/// Stiffnesses of supports' springs, N/mm: far below and far above that of any rod.
inline constexpr double softest_spring = 1e-6, stiffest_spring = 1e6;

/// Reads a file as its name's ending says:
///   .json  {"points_mm": [[x, y], ...], "rods": [[0, 1, ...], ...], "supports": [...]}; a rod is a
///          list of numbers of points (from 0) or of places [x, y], or {"points": list,
///          "diameter_mm": d}; a support {"point": number or place, "to_mm": [x, y, z]}, where
///          "to_mm" may be "free" (of an end that nothing holds) or left out (as the preset says),
///          and "spring_N_per_mm": k or [kx, ky, kz] puts it on a spring;
///          "joints": [[a, b, ...], ...] lists points that are one joint though they lie apart
///   .obj   "v x y z" and polylines "l a b c ..."
///   .dxf   LINE, LWPOLYLINE and POLYLINE, where there is a layer "rods" of that one alone
/// In the drawings of the last two rods are joined wherever they cross or touch, in JSON where they
/// name the same point or place, or points of one listed joint.
/// Points [x, y] lie at z = 0, others [x, y, z] in space; a rod that ends where it begins is a
/// ring. Errors (bad_input), with `name` and the line: not of the format, NaN, a point that is not
/// there, more than 100 000 points or rods, another ending.
Result<NetworkData> read_network(std::string_view bytes, const std::string& name);

/// The text of a .json file that reads back as the same network.
std::string network_json(const NetworkData& network);

/// What is wrong with a spring's stiffnesses along x, y, z; empty: nothing.
std::string spring_fault(const std::vector<double>& k);

/// What is wrong with a network that a preset holds itself; empty: nothing.
std::string network_fault(const NetworkData& network);

}  // namespace gridshell::preset
