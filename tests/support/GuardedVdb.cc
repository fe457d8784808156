// SPDX-License-Identifier: Apache-2.0
#include "GuardedVdb.h"

#include "VdbSamples.h"

#include <sstream>
#include <stdexcept>

namespace spheretree_test {

std::string GuardedVdb::saidOf(const std::string& bytes, DelayedMetadata treatment)
{
    std::stringbuf source(bytes);
    try {
        openvdb_spheretree::detail::VdbGuard(source, treatment).takeAll();
    } catch (const openvdb::Exception& error) {
        return error.what();
    }
    return "";
}

void GuardedVdb::expectSaid(
    const std::string& bytes, const std::string& words, DelayedMetadata treatment)
{
    const std::string said = saidOf(bytes, treatment);
    EXPECT_NE(said.find(words), std::string::npos) << "said: '" << said << "'";
}

openvdb::GridBase::Ptr vdbSample(const std::string& name)
{
    for (const auto& grid : vdbSamples()) {
        if (grid->getName() == name) return grid;
    }
    throw std::logic_error("no sample " + name);
}

std::string fileOf(const std::string& name, uint32_t compression)
{
    return vdbBytes({vdbSample(name)}, compression);
}

size_t behind(const std::string& bytes, const std::string& text)
{
    const size_t at = bytes.rfind(text);
    EXPECT_NE(at, std::string::npos) << text;
    return at + text.size();
}

} // namespace spheretree_test
