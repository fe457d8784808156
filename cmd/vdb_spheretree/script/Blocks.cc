// SPDX-License-Identifier: Apache-2.0
#include "Blocks.h"

#include "base/Errors.h"

namespace command {

std::vector<size_t> endsOfBlocks(const std::vector<ActionCall>& line)
{
    constexpr size_t kDeepest = 16;
    std::vector<size_t> ends(line.size()), open;
    for (size_t i = 0; i < line.size(); ++i) {
        const Block block = line[i].spec().block;
        if (block == Block::None) continue;
        if (block != Block::End) {
            open.push_back(i);
            if (open.size() > kDeepest)
                throwUsage(line[i].where() + ": loops are more than 16 deep");
            continue;
        }
        if (open.empty()) {
            throwUsage(line[i].where() + " ends nothing: no -for, -each, -files or -if is open");
        }
        ends[open.back()] = i;
        open.pop_back();
    }
    if (!open.empty()) {
        throwUsage(
            line[open.back()].where() + " has no -end: put it after the last of its actions");
    }
    return ends;
}

} // namespace command
