#!/bin/sh
# tests/formats.sh PROGRAM: opens the files that `gridshell export` writes with other programs, as far
# as they are installed (python3-ezdxf, python3-vtk9, paraview, librsvg2-bin, libxml2-utils,
# poppler-utils, chromium, blender); prints what was left out. Exit code 1 if one fails.
set -e
program=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
"$program" run s1_actuation --frames 12 --set accuracy.edges_per_segment=4 --quiet -o run
for file in a.dxf a.glb a.html a.obj a.pvd a.vtp a.xdmf; do
  "$program" export run --to "$file" > /dev/null
done
for thing in footprint plate; do
  for kind in svg dxf; do "$program" export run --what $thing --to $thing.$kind > /dev/null; done
done
"$program" export run --to sheet.pdf > /dev/null
"$program" export run --what cutlist --to cutlist.pdf > /dev/null

failed=0
# try NAME PROGRAM COMMAND...: runs the command if the program is installed
try() {
  name=$1
  if ! command -v "$2" > /dev/null; then
    echo "left out: $name ($2 is not installed)"
    return
  fi
  shift 2
  if "$@" > log 2>&1; then
    echo "ok: $name"
  else
    echo "FAILED: $name"
    cat log
    failed=1
  fi
}
# python NAME MODULE: runs the script on stdin if the module is installed
python() {
  cat > script.py
  if /usr/bin/python3 -c "import $2" 2> /dev/null; then
    try "$1" /usr/bin/python3 /usr/bin/python3 script.py
  else
    echo "left out: $1 ($2 is not installed)"
  fi
}

try 'XML' xmllint xmllint --noout a.xdmf a.vtp a.pvd footprint.svg plate.svg
try 'SVG' rsvg-convert rsvg-convert footprint.svg -o footprint.png
try 'PDF' pdftotext sh -c 'pdftotext sheet.pdf - | grep -q "Cut 24 rods" && pdftotext cutlist.pdf - | grep -q 251.2'
python 'DXF' ezdxf << 'END'
import ezdxf
for name, lines in (("a", 0), ("footprint", 24 + 240), ("plate", 0)):
    drawing = ezdxf.readfile(name + ".dxf")
    assert drawing.units == 4 and not drawing.audit().errors
    assert len(drawing.modelspace().query("LINE")) == lines
rods = ezdxf.readfile("a.dxf").modelspace().query('POLYLINE[layer=="rods"]')
assert len(rods) == 24 and rods[0].is_3d_polyline
assert abs(ezdxf.readfile("plate.dxf").modelspace().query("CIRCLE")[0].dxf.radius - 94.5) < 1e-6
END
python 'VTP' vtkmodules.vtkIOXML << 'END'
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
reader = vtkXMLPolyDataReader()
reader.SetFileName("a.vtp")
reader.Update()
shape = reader.GetOutput()
assert shape.GetNumberOfLines() == 24 and shape.GetNumberOfPolys() == 97
assert shape.GetPointData().GetArray("curvature_per_mm").GetRange()[1] > 0.01
assert shape.GetPointData().GetArray("axial_force_N").GetFiniteRange()[0] < -0.01
assert shape.GetPointData().GetArray("reaction_N").GetFiniteRange(-1)[1] > 0.01
assert shape.GetCellData().GetArray("K_rad").GetRange()[1] > 0.5
END
cat > open.py << 'END'
from paraview.simple import PVDReader, XDMFReader
for reader in PVDReader(FileName="a.pvd"), XDMFReader(FileNames=["a.xdmf"]):
    reader.UpdatePipeline()
    assert len(reader.TimestepValues) == 12
    reader.UpdatePipeline(1.0)
    bounds = reader.GetDataInformation().GetBounds()
    assert 98 < bounds[1] < 100 and 49 < bounds[5] < 50, bounds
xdmf = reader.GetDataInformation()
for name in "axial_force_N", "reaction_N":
    assert xdmf.GetCellDataInformation().GetArrayInformation(name), name
END
try 'PVD and XDMF' pvpython pvpython open.py
cat > blender.py << 'END'
import bpy, numpy
numpy.bool = bool  # of Debian 12: its Blender needs what its NumPy no longer has
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_scene.gltf(filepath="a.glb")
meshes = [thing for thing in bpy.data.objects if thing.type == "MESH"]
assert len(meshes) == 2 + 120, len(meshes)  # rods, cells, joints
rods = next(mesh for mesh in meshes if "rods" in mesh.name)
shapes = rods.data.shape_keys
assert len(shapes.key_blocks) == 1 + 11, len(shapes.key_blocks)  # the first frame is the mesh itself
keys = shapes.animation_data.action or shapes.animation_data.nla_tracks[0].strips[0].action
assert all(len(curve.keyframe_points) == 12 for curve in keys.fcurves)
assert {"rods", "joints", "cells"} <= {material.name for material in bpy.data.materials}
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_scene.obj(filepath="a.obj")
lines = bpy.data.objects[0].data
assert len(bpy.data.objects) == 1 and len(lines.vertices) == 1080 and len(lines.edges) == 1272
END
try 'glTF and OBJ in Blender' blender blender --background --python-exit-code 3 --python blender.py
try 'page' chromium sh -c 'chromium --headless --no-sandbox --disable-gpu --virtual-time-budget=3000 --dump-dom \
  "file://$PWD/a.html" | grep -q "frame 12 of 12"'
exit $failed
