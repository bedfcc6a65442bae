// Shapes as text for other programs: Rhino and Blender (.obj, .dxf), ParaView (.vtp, .pvd, .xdmf),
// spreadsheets (.csv). Millimetres, z up.
#pragma once

#include <string>
#include <vector>

#include "engine/export/drawing.h"
#include "engine/export/shape.h"

namespace gridshell::exports {

/// Wavefront: a line element a rod (group `rods`), a point a joint, a face a cell (group `cells`).
std::string to_obj(const Shape& shape);
/// The same with rods as tubes of their diameter (8 sides), and without joints.
std::string to_obj_tubes(const Shape& shape);

/// Rods as 3D polylines (layer `rods`) and the actuated boundary, for to_dxf().
Drawing rods_in_space(const Shape& shape);

/// VTK PolyData in ASCII: a polyline a rod with points of its own, a polygon a cell. Point data:
/// `displacement_mm`, `curvature_per_mm`, `axial_force_N` (the mean of the edges that meet),
/// `reaction_N` (of what holds a point; a joint's at the cells' corner alone); cell data: `rod` (-1
/// for a cell), `K_rad` (nan for a rod); field data: `TimeValue` (progress).
std::string to_vtp(const Shape& shape);
/// ParaView's list of such files over progress.
std::string to_pvd(const std::vector<double>& progress, const std::vector<std::string>& files);

/// XDMF of all frames of `trajectory.h5`: edges over /nodes at each progress with `axial_force_N`,
/// and the supports with `reaction_N`. For ParaView's `XDMF
/// Reader`; its Xdmf3 readers know no HyperSlab.
std::string to_xdmf(const record::Layout& layout, const record::FrameList& frames,
                    const std::string& trajectory);

/// `rod,point,x_mm,y_mm,z_mm,curvature_per_mm,axial_force_N,reaction_x_N,reaction_y_N,
/// reaction_z_N`, rod by rod; forces empty where the run did not record them.
std::string to_csv(const Shape& shape);

}  // namespace gridshell::exports
