// SPDX-License-Identifier: Apache-2.0
/// @file FuzzVdb.cc
/// @brief Fuzz target: `.vdb` files, grids and sphere-trees, read as -read does. Half of its mutants
/// change a field at its place (inputs/FileFields.h), which bytes at random seldom do.

#include "FuzzTarget.h"

#include "inputs/FileFields.h"
#include "inputs/Mutants.h"

#include <algorithm>

extern "C" std::size_t LLVMFuzzerMutate(uint8_t* data, std::size_t size, std::size_t most);

/// Half of the inputs are read with delayed loading, by the last bit of their size.
int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size)
{
    return spheretree_test::readAsFile(".vdb", data, size, /*delayed=*/size % 2);
}

extern "C" std::size_t LLVMFuzzerCustomMutator(
    uint8_t* data, std::size_t size, std::size_t most, unsigned seed)
{
    using namespace spheretree_test;
    Random random(seed);
    if (random() % 2) return LLVMFuzzerMutate(data, size, most);

    // The same input is changed several times over: its fields are found once.
    static std::string bytes;
    static std::vector<Field> fields;
    if (std::string now = textOf(data, size); now != bytes) {
        bytes = std::move(now);
        fields = vdbFields(bytes);
    }
    const std::string mutant = fieldMutant(bytes, fields, random);
    const std::size_t kept = std::min(mutant.size(), most);
    std::copy_n(mutant.begin(), kept, data);
    return kept;
}
