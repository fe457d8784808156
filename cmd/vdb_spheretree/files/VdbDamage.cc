// SPDX-License-Identifier: Apache-2.0
#include "VdbDamage.h"

#include "base/Errors.h"
#include "base/Stop.h"
#include "Companions.h"

#include <openvdb_spheretree/base/Text.h>
#include <openvdb_spheretree/store/SphereTreePoints.h>

#include <openvdb/Exceptions.h>
#include <openvdb/util/NullInterrupter.h>

#include <new>
#include <vector>

namespace command {

namespace {

using openvdb::points::PointDataGrid;

/// Asks as reading does, without progress to be shown.
class StopAsker : public openvdb::util::NullInterrupter {
public:
    bool wasInterrupted(int = -1) override { return stopRequested(); }
};

/// @return why a tree is not read with these companions; empty if it is.
std::string whyNot(const PointDataGrid& tree, const PointDataGrid* dag, const PointDataGrid* cuts)
{
    throwIfStopped();
    StopAsker stop;
    try {
        openvdb_spheretree::fromPoints(tree, dag, cuts, &stop);
        return {};
    } catch (const openvdb::Exception& error) {
        return oneLine(openvdb_spheretree::detail::messageOf(error), 300);
    }
}

/// Each companion by itself, so that damage of one does not hide that of the other.
std::vector<std::string> damageOf(const PointDataGrid& tree, const Companions& companions)
{
    const std::string own = whyNot(tree, nullptr, nullptr);
    if (!own.empty()) return {own};
    std::vector<std::string> damage;
    for (const std::string& why :
        {companions.dag ? whyNot(tree, companions.dag.get(), nullptr) : std::string(),
            companions.cuts ? whyNot(tree, nullptr, companions.cuts.get()) : std::string()}) {
        if (!why.empty()) damage.push_back(why);
    }
    return damage;
}

/// A file may have thousands of trees.
std::string listed(const std::vector<std::string>& damage)
{
    constexpr std::size_t kMost = 3;
    std::string text;
    for (std::size_t i = 0; i < damage.size() && i < kMost; ++i) {
        text += (i > 0 ? "; " : "") + damage[i];
    }
    if (damage.size() > kMost) {
        text += "; and " + std::to_string(damage.size() - kMost) + " more such grids";
    }
    return text;
}

std::string foundDamage(const openvdb::GridPtrVec& grids)
{
    const CompanionIndex index(grids);
    std::vector<std::string> damage;
    bool areSummed = false, areAllSummed = true;
    for (const openvdb::GridBase::Ptr& grid : grids) {
        if (!openvdb_spheretree::isSphereTree(*grid)) continue;
        const bool isSummed = openvdb_spheretree::hasChecksum(*grid);
        areSummed = areSummed || isSummed;
        areAllSummed = areAllSummed && isSummed;
        const auto points = openvdb::gridPtrCast<PointDataGrid>(grid);
        for (const std::string& why : damageOf(*points, index.of(grid->getName()))) {
            damage.push_back(why);
        }
    }
    if (!damage.empty()) return listed(damage);
    if (!areSummed) return "no grid in it has a checksum of its own that would say where";
    const std::string whole = areAllSummed ? "its trees are whole by their own checksums"
                                           : "those of its trees that have checksums are whole by "
                                             "them";
    return whole
        + "; what changed is the file's header, a name, another grid, or what OpenVDB stores "
          "around the points";
}

} // namespace

std::string placeOfDamage(const openvdb::GridPtrVec& grids)
{
    try {
        return foundDamage(grids);
    } catch (const std::bad_alloc&) {
        return "nobody knows where, as there is not enough memory to look";
    }
}

} // namespace command
