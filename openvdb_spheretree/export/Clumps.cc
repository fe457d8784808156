// SPDX-License-Identifier: Apache-2.0
// Clumps of spheres for programs of discrete elements: a line a sphere, each with its own kind of first lines.

#include "ExportText.h"
#include "ExportWriters.h"

#include <cmath>

namespace openvdb_spheretree::detail {

namespace {

void writeRows(
    ExportText& text, const ExportLevel& level, std::string_view separator, std::string_view end)
{
    for (std::size_t i = 0; i < level.size(); ++i) {
        text.lengths(level.centers[i], separator) << separator << level.radii[i] << end;
    }
}

void writeTable(const ExportScene& scene, std::string_view header, const ExportSink& out)
{
    ExportText text(out, scene.decimals);
    text << header;
    writeRows(text, scene.finest(), ",", "\n");
    text.finish();
}

/// @return what each sphere weighs if all weigh `mass` together, by their volumes.
std::vector<double> sharesOf(const ExportLevel& level, double mass)
{
    std::vector<double> shares;
    double sum = 0;
    for (const double radius : level.radii) {
        shares.push_back(radius * radius * radius);
        sum += shares.back();
    }
    for (double& share : shares) share *= sum > 0 ? mass / sum : 0;
    return shares;
}

} // namespace

/// fix particletemplate/multisphere of LIGGGHTS: as many lines as its nspheres says.
void writeLiggghts(const std::vector<ExportScene>& samples, const ExportSink& out)
{
    const ExportScene& scene = samples.front();
    ExportText text(out, scene.decimals);
    text << "# " << oneWord(scene.name)
         << ": x y z radius; fix ... particletemplate/multisphere ... nspheres "
         << scene.finest().size() << " ... spheres file <this file> scale 1\n";
    writeRows(text, scene.finest(), " ", "\n");
    text.finish();
}

/// ymport.textClumps() of YADE: the fifth number is that of the clump. Empty lines would stop it.
void writeYade(const std::vector<ExportScene>& samples, const ExportSink& out)
{
    const ExportScene& scene = samples.front();
    ExportText text(out, scene.decimals);
    text << "# " << oneWord(scene.name)
         << ": x y z radius clump; from yade import ymport; ymport.textClumps(...)\n";
    writeRows(text, scene.finest(), " ", " 0\n");
    text.finish();
}

/// The csv of multisphere and of GEMSS.
void writeMultisphere(const std::vector<ExportScene>& samples, const ExportSink& out)
{
    writeTable(samples.front(), "x,y,z,radius\n", out);
}

/// The csv of DEM-Engine, which takes no column more.
void writeDeme(const std::vector<ExportScene>& samples, const ExportSink& out)
{
    writeTable(samples.front(), "x,y,z,r\n", out);
}

/// A molecule of LAMMPS for its rigid fixes, which take mass, center and inertia from here:
/// https://docs.lammps.org/molecule.html
void writeLammps(const std::vector<ExportScene>& samples, const ExportSink& out)
{
    const ExportScene& scene = samples.front();
    const ExportLevel& level = scene.finest();
    const double mass = scene.mass.volume * scene.density;
    ExportText text(out, scene.decimals);
    text << "# " << oneWord(scene.name) << ": spheres\n\n" << level.size() << " atoms\n";
    text.real(mass) << " mass\n";
    text.reals(scene.mass.center.asPointer(), 3) << " com\n";
    text.reals(scene.inertia().data(), 6) << " inertia\n\nCoords\n\n";
    for (std::size_t i = 0; i < level.size(); ++i) {
        text << i + 1 << ' ';
        text.lengths(level.centers[i], " ") << '\n';
    }
    text << "\nTypes\n\n";
    for (std::size_t i = 0; i < level.size(); ++i) text << i + 1 << " 1\n";
    text << "\nDiameters\n\n";
    for (std::size_t i = 0; i < level.size(); ++i)
        text << i + 1 << ' ' << 2 * level.radii[i] << '\n';
    text << "\nMasses\n\n";
    const std::vector<double> shares = sharesOf(level, mass);
    for (std::size_t i = 0; i < level.size(); ++i) {
        text << i + 1 << ' ';
        text.real(shares[i]) << '\n';
    }
    text.finish();
}

} // namespace openvdb_spheretree::detail
