// SPDX-License-Identifier: Apache-2.0
#include "Errors.h"

#include "Terminal.h"

#include <openvdb/Exceptions.h>
#include <openvdb_spheretree/base/EmptyObject.h>
#include <openvdb_spheretree/base/Interrupted.h>
#include <openvdb_spheretree/base/Text.h>

#include <cerrno>
#include <cstring>
#include <ios>
#include <iostream>
#include <new>
#include <string_view>
#include <system_error>

namespace command {

using openvdb_spheretree::Interrupted;

namespace {

std::string joined(const std::string& where, const std::string& message)
{
    return where.empty() ? message : where + ": " + message;
}

} // namespace

void throwUsage(const std::string& message) { throw CommandError(kUsage, message); }
void throwInput(const std::string& message) { throw CommandError(kInput, message); }
void throwOutput(const std::string& message) { throw CommandError(kOutput, message); }

std::string oneLine(const std::string& text, size_t limit)
{
    return openvdb_spheretree::detail::onOneLine(text, limit);
}

std::string systemError(const std::string& path) { return path + ": " + std::strerror(errno); }

bool isLackOfThreads(const std::exception& error)
{
    const auto* const system = dynamic_cast<const std::system_error*>(&error);
    if (system && system->code() == std::errc::resource_unavailable_try_again) return true;
    return std::string_view(error.what()).find("pthread_create") != std::string_view::npos;
}

void rethrowNamed(const std::string& where, ExitCode fallback)
{
    try {
        throw;
    } catch (const EmptyError& error) {
        throw EmptyError(joined(where, error.what()));
    } catch (const CommandError& error) {
        throw CommandError(error.code(), joined(where, error.what()));
    } catch (const Interrupted&) {
        throw;
    } catch (const openvdb_spheretree::EmptyObject& error) {
        throw EmptyError(joined(where, openvdb_spheretree::detail::messageOf(error)));
    } catch (const openvdb::Exception& error) {
        // Clipped first: copying the whole of it could need gigabytes.
        const std::string what(error.what(), strnlen(error.what(), 1000));
        throw CommandError(
            fallback, joined(where, std::string(openvdb_spheretree::detail::withoutType(what))));
    } catch (const std::bad_alloc&) {
        const ExitCode code = fallback == kUsage ? kInput : fallback; // the line may be right
        throw CommandError(code, joined(where, kNoMemory));
    } catch (const std::length_error&) {
        throw CommandError(fallback, joined(where, "asks for more memory than there can be"));
    } catch (const std::ios_base::failure&) {
        throw CommandError(fallback, joined(where, "reading or writing failed"));
    } catch (const std::exception& error) {
        if (isLackOfThreads(error)) throw CommandError(kInput, joined(where, kNoThread));
        throw CommandError(fallback, joined(where, error.what()));
    }
}

int reportError(std::exception_ptr error)
{
    const std::string start = "vdb_spheretree: " + coloured(std::cerr, Colour::Red, "error: ");
    try {
        std::rethrow_exception(error);
    } catch (const CommandError& e) {
        std::cerr << start << oneLine(e.what(), 2000) << std::endl;
        return e.code();
    } catch (const Interrupted&) {
        std::cerr << "vdb_spheretree: interrupted" << std::endl;
        return kInterrupted;
    } catch (const std::bad_alloc&) {
        std::cerr << start << kNoMemory << std::endl;
        return kInput;
    } catch (const std::exception& e) {
        if (isLackOfThreads(e)) {
            std::cerr << start << kNoThread << std::endl;
            return kInput;
        }
        std::cerr << start << "unexpected: " << oneLine(e.what()) << std::endl;
    } catch (...) {
        std::cerr << start << "unexpected" << std::endl;
    }
    return kInternal;
}

} // namespace command
