// SPDX-License-Identifier: Apache-2.0
/// @file ExportWriters.h
/// @brief A function for each format of the table in ExportFormat.cc. They write scenes as they are: what
/// cannot be in a file was refused, rounded or left out before. All but those with `samples` or `links` get one scene.

#pragma once

#include "ExportBuffer.h"
#include "ExportScene.h"

#include <cstdint>
#include <vector>

namespace openvdb_spheretree::detail {

/// @name Robots
/// @{
void writeUrdf(const std::vector<ExportScene>& samples, const ExportSink& out);
void writeMjcf(const std::vector<ExportScene>& samples, const ExportSink& out);
void writeSrdf(const std::vector<ExportScene>& links, const ExportSink& out);
void writeCurobo(const std::vector<ExportScene>& links, const ExportSink& out);
void writeXrdf(const std::vector<ExportScene>& links, const ExportSink& out);
void writeLula(const std::vector<ExportScene>& links, const ExportSink& out);
void writeFoam(const std::vector<ExportScene>& samples, const ExportSink& out);
void writeMorphIt(const std::vector<ExportScene>& samples, const ExportSink& out);
/// @}

/// @name Film
/// @{
void writeUsda(const std::vector<ExportScene>& samples, const ExportSink& out);
void writePly(const std::vector<ExportScene>& samples, const ExportSink& out);
void writePlyAscii(const std::vector<ExportScene>& samples, const ExportSink& out);
void writeGlb(const std::vector<ExportScene>& samples, const ExportSink& out);
void writeNanoVdbPoints(const std::vector<ExportScene>& samples, const ExportSink& out);
/// @}

/// @name Meshes of spheres
/// @{
void writeMeshObj(const std::vector<ExportScene>& samples, const ExportSink& out);
void writeMeshStl(const std::vector<ExportScene>& samples, const ExportSink& out);
void writeMeshGlb(const std::vector<ExportScene>& samples, const ExportSink& out);
/// @throw openvdb::ValueError if an .stl cannot have so many: it counts them in 32 bits
void requireStlTriangles(uint64_t triangles);
void writeUnrealObj(const std::vector<ExportScene>& samples, const ExportSink& out);
/// @}

/// @name Science
/// @{
void writeVtp(const std::vector<ExportScene>& samples, const ExportSink& out);
void writeVtk(const std::vector<ExportScene>& samples, const ExportSink& out);
void writeLiggghts(const std::vector<ExportScene>& samples, const ExportSink& out);
void writeYade(const std::vector<ExportScene>& samples, const ExportSink& out);
void writeLammps(const std::vector<ExportScene>& samples, const ExportSink& out);
void writeMultisphere(const std::vector<ExportScene>& samples, const ExportSink& out);
void writeDeme(const std::vector<ExportScene>& samples, const ExportSink& out);
void writeXyz(const std::vector<ExportScene>& samples, const ExportSink& out);
void writeSwc(const std::vector<ExportScene>& samples, const ExportSink& out);
void writeSph(const std::vector<ExportScene>& samples, const ExportSink& out);
/// @}

} // namespace openvdb_spheretree::detail
