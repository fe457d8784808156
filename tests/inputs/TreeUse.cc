// SPDX-License-Identifier: Apache-2.0
#include "TreeUse.h"

#include "VdbSamples.h"

#include <openvdb_spheretree/check/TreeCheck.h>
#include <openvdb_spheretree/export/ExportTree.h>
#include <openvdb_spheretree/picture/SpherePicture.h>
#include <openvdb_spheretree/query/Collide.h>
#include <openvdb_spheretree/query/QueryTree.h>
#include <openvdb_spheretree/store/SphereTreeCsv.h>
#include <openvdb_spheretree/store/SphereTreeJson.h>
#include <openvdb_spheretree/store/SphereTreePoints.h>
#include <openvdb_spheretree/tree/LevelSpheres.h>

#include <openvdb/Exceptions.h>

#include <ostream>
#include <streambuf>

namespace spheretree_test {

using namespace openvdb_spheretree;

namespace {

/// Takes all that is written to it, and keeps nothing.
class NoBuffer : public std::streambuf {
protected:
    int_type overflow(int_type c) override { return traits_type::not_eof(c); }
    std::streamsize xsputn(const char*, std::streamsize count) override { return count; }
};

/// Runs a use of the tree, which may be refused.
template <typename Use>
void attempt(const Use& use)
{
    try {
        use();
    } catch (const openvdb::ValueError&) {
    } catch (const openvdb::ArithmeticError&) { // OpenVDB's, of transforms that have no inverse
    }
}

void drawSmall(const SphereTree& tree, int level)
{
    PictureSettings settings;
    settings.width = settings.height = 4;
    settings.samples = 2;
    settings.lightRays = 1;
    const Camera camera = viewOf(tree.object.bbox, *tree.transform, {0, 1, 0}, 40, 1);
    renderLevel(tree, level, camera, settings);
}

} // namespace

void useTree(const SphereTree& tree)
{
    NoBuffer nothing;
    std::ostream out(&nothing);
    attempt([&] { checkSphereTree(tree, *sampleObject()); });
    attempt([&] { toPoints(tree); });
    attempt([&] { dagToPoints(tree); });
    attempt([&] { cutsToPoints(tree); });
    attempt([&] { writeCsv(tree, out); });
    attempt([&] { writeJson(tree, out); });
    for (const char* extension : {".usda", ".urdf", ".vtp"}) {
        attempt([&] { exportTree(tree, *findExportFormat(extension), {}, out); });
    }
    for (std::size_t k = 0; k < tree.levels.size(); ++k) {
        attempt([&] { levelUnion(tree, tree.levels[k]); });
        attempt([&] { drawSmall(tree, int(k)); });
    }
    attempt([&] {
        const QueryTree asked = makeQueryTree(tree);
        collide(asked, {}, asked, {});
    });
}

} // namespace spheretree_test
