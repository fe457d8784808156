// SPDX-License-Identifier: Apache-2.0
/// @file LeafValues.h
/// @brief The values of a leaf node, also where OpenVDB has left them in the file (delayed
/// loading).
///
/// Asking such a leaf for a value would read all of its values and keep them, leaf after leaf,
/// until the whole grid is in memory. The copy of a leaf's buffer is in the file likewise, so a
/// copy is read in its place, and let go.

#pragma once

#include <memory>

namespace openvdb_spheretree::detail {

template <typename LeafT>
class LeafValues {
public:
    using ValueType = typename LeafT::ValueType;

    /// The leaf must stay where it is for as long as this is used. Any number of threads may do
    /// so with different leaves.
    /// @throw openvdb::Exception if the values cannot be read: the file is damaged, or has changed
    explicit LeafValues(const LeafT& leaf) : mValues(nullptr)
    {
        if (leaf.buffer().isOutOfCore()) {
            mCopy = std::make_unique<Buffer>(leaf.buffer());
            load();
        }
        mValues = mCopy ? mCopy->data() : leaf.buffer().data();
    }

    const ValueType& operator[](std::size_t n) const { return mValues[n]; }
    const ValueType* data() const { return mValues; }

private:
    using Buffer = typename LeafT::Buffer;

    /// A buffer of OpenVDB that has failed to load takes its own memory for a reference to the
    /// file: it must not be destroyed.
    void load()
    {
        try {
            mCopy->data();
        } catch (...) {
            static_cast<void>(mCopy.release());
            throw;
        }
    }

    std::unique_ptr<Buffer> mCopy;
    const ValueType* mValues;
};

} // namespace openvdb_spheretree::detail
