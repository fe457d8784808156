// SPDX-License-Identifier: Apache-2.0
/// @file ViewerPage.h
/// @brief The page of the viewer without a tree. cmake/SpheretreeEmbedPage.cmake makes the texts from
/// the files of viewer/page/.

#pragma once

namespace openvdb_spheretree::detail {

/// @name Parts in their order, a null pointer at the end. The data stands between the two.
/// @{
extern const char* const kPageBeforeData[];
extern const char* const kPageAfterData[];
/// @}

} // namespace openvdb_spheretree::detail
