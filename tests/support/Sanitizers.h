// SPDX-License-Identifier: Apache-2.0
/// @file Sanitizers.h
/// @brief Whether a sanitizer is compiled in, of gcc or clang. Its process has terabytes of addresses,
/// so that they cannot be limited, and a malloc, an operator new and handlers of signals of its own.

#pragma once

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define SPHERETREE_TEST_SANITIZED true
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define SPHERETREE_TEST_SANITIZED true
#endif
#endif
#ifndef SPHERETREE_TEST_SANITIZED
#define SPHERETREE_TEST_SANITIZED false
#endif

namespace spheretree_test {

constexpr bool kSanitized = SPHERETREE_TEST_SANITIZED;

} // namespace spheretree_test
