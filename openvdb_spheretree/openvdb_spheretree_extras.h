// SPDX-License-Identifier: Apache-2.0
/// @file openvdb_spheretree_extras.h
/// @brief The public headers of the library openvdb_spheretree_extras: grids from files of
/// strangers, objects from meshes, volume files and formulas, pictures of objects and trees, pages of
/// trees, curves of their errors, and trees for the files of other tools.

#pragma once

#include "chart/ErrorChart.h"
#include "export/ExportFormat.h"
#include "export/ExportTree.h"
#include "export/NanoVdbWriter.h"
#include "export/VolWriter.h"
#include "input/array/NumberType.h"
#include "input/mesh/MeshFile.h"
#include "input/mesh/MeshLevelSet.h"
#include "input/shapes/GeneratedObject.h"
#include "input/vdb/VdbGrids.h"
#include "input/vol/VolFile.h"
#include "input/volume/VolumeFile.h"
#include "picture/Camera.h"
#include "picture/Picture.h"
#include "picture/SpherePicture.h"
#include "viewer/TreeViewer.h"
