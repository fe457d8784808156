// SPDX-License-Identifier: Apache-2.0
#include "Stack.h"

#include "base/Errors.h"
#include "expression/FrameName.h"

#include <openvdb_spheretree/input/volume/VolumeFile.h>

#include <openvdb/points/PointDataGrid.h>

#include <algorithm>
#include <filesystem>
#include <map>

namespace command {

namespace {

bool isNumber(const std::string& text)
{
    return !text.empty() && text.size() < 6
        && text.find_first_not_of("0123456789") == std::string::npos;
}

std::string namesOf(const std::vector<StackItem*>& items)
{
    constexpr std::size_t kNamed = 6;
    std::string names;
    for (std::size_t i = 0; i < std::min(kNamed, items.size()); ++i) {
        names += (i ? ", " : "") + items[i]->description();
    }
    if (items.size() > kNamed) names += " and " + std::to_string(items.size() - kNamed) + " more";
    return names;
}

/// What a shell has made of `smoke_*.vdb` was seldom meant to be taken all at once.
std::string asSequence(const std::vector<StackItem*>& items)
{
    std::vector<std::string> sources;
    for (const StackItem* item : items) sources.push_back(item->source);
    const std::string pattern = patternOf(sources);
    if (pattern.empty()) return {};
    return std::string("; -read ") + pattern
        + (openvdb_spheretree::isStackName(pattern) ? " takes them as slices of one volume"
                                                    : " takes them one by one, as frames");
}

} // namespace

std::string StackItem::name() const
{
    if (tree) return tree->settings.name;
    return grid ? grid->getName() : mesh->name;
}

std::string StackItem::fileStem() const
{
    return isOfFile ? std::filesystem::path(source).stem().string() : "";
}

std::string StackItem::description() const
{
    std::string kind = "mesh", details;
    if (tree) {
        kind = tree->settings.isGiven() ? "spheres" : "sphere-tree";
    } else if (emptyTree) {
        kind = "sphere-tree without spheres";
    } else if (grid) {
        kind = "grid";
        const bool isPoints = grid->isType<openvdb::points::PointDataGrid>();
        details = isPoints ? "points" : grid->valueType();
        if (grid->getGridClass() != openvdb::GRID_UNKNOWN) {
            details += ", " + openvdb::GridBase::gridClassToMenuName(grid->getGridClass());
        }
        details += ", ";
    }
    return kind + " '" + oneLine(name(), 60) + "' (" + details + "from " + oneLine(source, 120)
        + ")";
}

std::vector<std::string> distinctNames(const std::vector<const StackItem*>& items)
{
    std::map<std::string, int> names, files;
    for (const StackItem* item : items) {
        ++names[item->name()];
        ++files[item->fileStem()];
    }
    std::vector<std::string> result;
    for (const StackItem* item : items) {
        const std::string name = item->name(), file = item->fileStem();
        const bool isOfName = !name.empty() && names[name] == 1;
        const bool isOfFile = !file.empty() && files[file] == 1 && names.count(file) == 0;
        result.push_back(isOfName ? name : isOfFile ? file : "");
    }
    return result;
}

void Stack::beginBatch(const std::string& source)
{
    mSource = source;
    mIsFile = false;
    ++mBatch;
}

void Stack::setFile(const std::string& path)
{
    mSource = path;
    mIsFile = true;
}

void Stack::push(StackItem item)
{
    std::vector<const StackItem*> written;
    for (const auto& old : mItems) {
        if (old->written) written.push_back(old.get());
    }
    for (const StackItem* old : written) giveUp(old);
    item.source = mSource;
    item.isOfFile = mIsFile;
    item.batch = mBatch;
    item.frame = mFrame;
    item.serial = mPushed++;
    item.depth = mTurns.size();
    mItems.push_back(std::make_unique<StackItem>(std::move(item)));
}

void Stack::drop(const StackItem* item)
{
    const auto isIt = [item](const auto& other) { return other.get() == item; };
    mItems.erase(std::remove_if(mItems.begin(), mItems.end(), isIt), mItems.end());
}

void Stack::giveUp(const StackItem* item)
{
    const bool isOfThisTurn = !mTurns.empty() && item->serial >= mTurns.back();
    if (isOfThisTurn && item->anyTree()) mGivenUp.push_back({item->serial, item->depth});
    drop(item);
}

bool Stack::isOfEndedLoop(int64_t serial, std::size_t depth) const
{
    return depth > mTurns.size() && serial >= (mTurns.empty() ? 0 : mTurns.back());
}

int64_t Stack::writtenAndGone() const
{
    return std::count_if(mGivenUp.begin(), mGivenUp.end(),
        [this](const GivenUp& gone) { return isOfEndedLoop(gone); });
}

void Stack::beginLoop()
{
    const auto isOld = [this](const GivenUp& gone) { return isOfEndedLoop(gone); };
    mGivenUp.erase(std::remove_if(mGivenUp.begin(), mGivenUp.end(), isOld), mGivenUp.end());
}

void Stack::clear()
{
    mItems.clear();
    mGivenUp.clear();
}

std::vector<StackItem> Stack::copies() const
{
    std::vector<StackItem> all;
    for (const auto& item : mItems) {
        if (!item->written) all.push_back(*item);
    }
    return all;
}

void Stack::restore(const std::vector<StackItem>& copies)
{
    mItems.clear();
    for (const StackItem& item : copies) mItems.push_back(std::make_unique<StackItem>(item));
}

bool Stack::holdsMesh() const
{
    return std::any_of(mItems.begin(), mItems.end(), [](const auto& i) { return bool(i->mesh); });
}

bool Stack::newestTreeIsEmpty() const
{
    const auto newest = std::find_if(
        mItems.rbegin(), mItems.rend(), [](const auto& item) { return item->anyTree(); });
    return newest != mItems.rend() && (*newest)->emptyTree;
}

std::vector<StackItem*> Stack::oldestFirst(bool meshes)
{
    std::vector<StackItem*> items;
    for (const auto& item : mItems) {
        if (bool(item->mesh) == meshes) items.push_back(item.get());
    }
    return items;
}

std::vector<StackItem*> Stack::newestFirst(bool meshes)
{
    std::vector<StackItem*> items = oldestFirst(meshes);
    std::reverse(items.begin(), items.end());
    return items;
}

StackItem* Stack::find(const std::string& ageOrName, bool meshes)
{
    const std::vector<StackItem*> items = newestFirst(meshes);
    for (StackItem* item : items) {
        if (item->name() == ageOrName) return item;
    }
    if (isNumber(ageOrName)) {
        const size_t age = std::stoul(ageOrName);
        return age < items.size() ? items[age] : nullptr;
    }
    const auto isOfFile = [&](const StackItem* item) { return item->fileStem() == ageOrName; };
    const auto found = std::find_if(items.begin(), items.end(), isOfFile);
    return std::count_if(items.begin(), items.end(), isOfFile) == 1 ? *found : nullptr;
}

std::vector<StackItem*> Stack::ofAllTurns(StackItem* item, const std::string& ageOrName)
{
    const auto isOther = [&](const StackItem* other) {
        return !isOfEndedLoop(*other) || other->name() != ageOrName;
    };
    if (isOther(item)) return {item};
    std::vector<StackItem*> all = oldestFirst(false);
    all.erase(std::remove_if(all.begin(), all.end(), isOther), all.end());
    return all;
}

std::string Stack::listing() const
{
    if (mItems.empty()) return "the stack is empty";
    std::string all = "on the stack, newest first:";
    size_t shown = 0;
    for (auto item = mItems.rbegin(); item != mItems.rend() && shown < 12; ++item, ++shown) {
        all += (shown ? ", " : " ") + (*item)->description();
    }
    return shown < mItems.size() ? all + ", ..." : all;
}

void Stack::requireOneOfName(const StackItem& chosen)
{
    for (StackItem* item : newestFirst(bool(chosen.mesh))) {
        if (item == &chosen || item->batch != chosen.batch || item->name() != chosen.name())
            continue;
        throwInput("two are named '" + oneLine(chosen.name(), 60)
            + "': choose by age, with 0 for the newest (-print tells the ages)");
    }
}

StackItem& Stack::select(
    const std::string& what, const Suits& suits, const std::string& ageOrName, bool meshes)
{
    if (!ageOrName.empty()) {
        StackItem* const item = find(ageOrName, meshes);
        if (!item) throwInput("there is no '" + ageOrName + "'; " + listing());
        if (!suits(*item)) {
            throwInput(
                item->description() + " will not do: this action needs " + what + "; " + listing());
        }
        if (item->name() == ageOrName) requireOneOfName(*item);
        return *item;
    }
    std::vector<StackItem*> found;
    for (StackItem* item : newestFirst(meshes)) {
        if (!suits(*item)) continue;
        if (!found.empty() && found.front()->batch != item->batch) break;
        found.push_back(item);
    }
    if (found.empty()) throwInput("needs " + what + "; " + listing());
    if (found.size() == 1) return *found.front();
    throwInput("there is more than one that suits: " + namesOf(found) + "; choose one"
        + (meshes ? " with geo=" : ": here with vdb=, or with grids= of -read")
        + asSequence(found));
}

StackItem& Stack::selectTree(const std::string& ageOrName)
{
    const auto isTree = [](const StackItem& item) { return bool(item.tree); };
    if (ageOrName.empty() && newestTreeIsEmpty()) {
        throw EmptyError(
            "the newest sphere-tree is that of no object, without spheres; " + listing());
    }
    return select("a sphere-tree", isTree, ageOrName);
}

StackItem& Stack::selectMesh(const std::string& ageOrName)
{
    const auto any = [](const StackItem&) { return true; };
    return select("a mesh", any, ageOrName, /*meshes=*/true);
}

std::vector<StackItem*> Stack::several(const std::vector<std::string>& agesOrNames)
{
    std::vector<StackItem*> chosen;
    if (agesOrNames.empty() || agesOrNames == std::vector<std::string>{"*"}) {
        chosen = oldestFirst(false);
        const auto isWritten = [](const StackItem* item) { return item->written; };
        if (!std::all_of(chosen.begin(), chosen.end(), isWritten)) {
            chosen.erase(std::remove_if(chosen.begin(), chosen.end(), isWritten), chosen.end());
        }
    } else {
        for (const std::string& ageOrName : agesOrNames) {
            StackItem* const item = find(ageOrName, false);
            if (!item) throwInput("there is no '" + ageOrName + "'; " + listing());
            for (StackItem* one : ofAllTurns(item, ageOrName)) {
                if (!std::count(chosen.begin(), chosen.end(), one)) chosen.push_back(one);
            }
        }
    }
    if (chosen.empty()) throwInput("there is no grid or sphere-tree to work on; " + listing());
    return chosen;
}

} // namespace command
