// SPDX-License-Identifier: Apache-2.0
/// @file ExportWriters.h
/// @brief A function for each format of the table in ExportFormat.cc. They write scenes as they are: what
/// cannot be in a file was refused, rounded or left out before. All but those with `samples` get one scene.

#pragma once

#include "ExportScene.h"

#include <iosfwd>
#include <vector>

namespace openvdb_spheretree::detail {

/// @name Robots
/// @{
void writeUrdf(const std::vector<ExportScene>& samples, std::ostream& out);
void writeMjcf(const std::vector<ExportScene>& samples, std::ostream& out);
void writeSrdf(const std::vector<ExportScene>& samples, std::ostream& out);
void writeCurobo(const std::vector<ExportScene>& samples, std::ostream& out);
void writeXrdf(const std::vector<ExportScene>& samples, std::ostream& out);
void writeLula(const std::vector<ExportScene>& samples, std::ostream& out);
void writeFoam(const std::vector<ExportScene>& samples, std::ostream& out);
void writeMorphIt(const std::vector<ExportScene>& samples, std::ostream& out);
/// @}

/// @name Film
/// @{
void writeUsda(const std::vector<ExportScene>& samples, std::ostream& out);
void writePly(const std::vector<ExportScene>& samples, std::ostream& out);
void writePlyAscii(const std::vector<ExportScene>& samples, std::ostream& out);
void writeGlb(const std::vector<ExportScene>& samples, std::ostream& out);
void writeNanoVdbPoints(const std::vector<ExportScene>& samples, std::ostream& out);
/// @}

/// @name Meshes of spheres
/// @{
void writeMeshObj(const std::vector<ExportScene>& samples, std::ostream& out);
void writeMeshStl(const std::vector<ExportScene>& samples, std::ostream& out);
void writeMeshGlb(const std::vector<ExportScene>& samples, std::ostream& out);
void writeUnrealObj(const std::vector<ExportScene>& samples, std::ostream& out);
/// @}

/// @name Science
/// @{
void writeVtp(const std::vector<ExportScene>& samples, std::ostream& out);
void writeVtk(const std::vector<ExportScene>& samples, std::ostream& out);
void writeLiggghts(const std::vector<ExportScene>& samples, std::ostream& out);
void writeYade(const std::vector<ExportScene>& samples, std::ostream& out);
void writeLammps(const std::vector<ExportScene>& samples, std::ostream& out);
void writeMultisphere(const std::vector<ExportScene>& samples, std::ostream& out);
void writeDeme(const std::vector<ExportScene>& samples, std::ostream& out);
void writeXyz(const std::vector<ExportScene>& samples, std::ostream& out);
void writeSwc(const std::vector<ExportScene>& samples, std::ostream& out);
void writeSph(const std::vector<ExportScene>& samples, std::ostream& out);
/// @}

} // namespace openvdb_spheretree::detail
