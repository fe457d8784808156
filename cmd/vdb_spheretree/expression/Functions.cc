// SPDX-License-Identifier: Apache-2.0
#include "Functions.h"

#include "base/Errors.h"

#include <map>

namespace command {

namespace {

Function fact(const std::string& name, const std::string& doc)
{
    return {name, 1, doc, [name](Evaluation& e) {
                const int64_t age = e.operands.popWhole();
                if (age < 0) throwUsage("an age is 0 or more, and not " + std::to_string(age));
                if (!e.stack) throw NeedsStack();
                e.operands.push(e.stack->fact(name, age));
            }};
}

Function count(const std::string& name, const std::string& doc)
{
    return {name, 0, doc, [name](Evaluation& e) {
                if (!e.stack) throw NeedsStack();
                e.operands.push(e.stack->count(name));
            }};
}

} // namespace

std::vector<Function> stackFunctions()
{
    return {
        count("gridCount", "how many grids and sphere-trees there are"),
        fact("gridName", "{0:gridName} -> density: the name of a grid or sphere-tree"),
        fact("gridType", "{0:gridType} -> float: the type of its values, points or sphere-tree"),
        fact("gridClass", "{0:gridClass} -> ls: or fog, staggered, none"),
        fact("gridDim", "{0:gridDim} -> [255, 255, 255]: its box, in voxels"),
        fact("gridBBox", "{0:gridBBox} -> [-1,-1,-1] [1,1,1]: in world space"),
        fact("gridCenter", "{0:gridCenter} -> [0,0,0]: of that box"),
        fact("gridRadius", "{0:gridRadius} -> 1.73: of the ball around that box"),
        fact("voxelSize", "{0:voxelSize} -> 0.01"),
        fact("voxelCount", "{0:voxelCount} -> 3269821: active voxels; of a tree its object's"),
        fact("isLS", "{0:isLS} -> 1: whether it is a level set"),
        fact("isFOG", "{0:isFOG} -> 0: whether it is a fog volume"),
        fact("isGridEmpty", "{0:isGridEmpty} -> 0: whether it has no voxel"),
        fact("sphereCount", "{0:sphereCount} -> 585: of a sphere-tree"),
        fact("levelCount", "{0:levelCount} -> 4: of a sphere-tree"),
        count("geomCount", "how many meshes there are"),
        fact("geomName", "{0:geomName} -> bunny"),
        fact("geomBBox", "as gridBBox, of a mesh"),
        fact("geomCenter", "as gridCenter, of a mesh"),
        fact("geomRadius", "as gridRadius, of a mesh"),
        fact("vtxCount", "{0:vtxCount} -> 2461023: vertices of a mesh"),
        fact("polyCount", "{0:polyCount} -> 23560: triangles of a mesh"),
        fact("isGeomEmpty", "{0:isGeomEmpty} -> 0: whether a mesh has no vertex"),
    };
}

const std::vector<Function>& allFunctions()
{
    static const std::vector<Function> all = [] {
        std::vector<Function> functions;
        for (const auto& part : {arithmeticFunctions(), logicFunctions(), operandFunctions(),
                 textFunctions(), stackFunctions()}) {
            functions.insert(functions.end(), part.begin(), part.end());
        }
        return functions;
    }();
    return all;
}

const Function* findFunction(const std::string& name)
{
    static const std::map<std::string, const Function*> byName = [] {
        std::map<std::string, const Function*> map;
        for (const Function& function : allFunctions()) map[function.name] = &function;
        return map;
    }();
    const auto found = byName.find(name);
    return found == byName.end() ? nullptr : found->second;
}

} // namespace command
