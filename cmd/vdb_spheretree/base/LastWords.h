// SPDX-License-Identifier: Apache-2.0
/// @file LastWords.h
/// @brief What the program says and returns where it can only end at once: an exception that nothing
/// can catch, an input file that was cut short after it had been mapped into memory, and a stop that
/// was asked for and is overdue.
///
/// It ends without unwinding, and then removes temporary files that have a name (RememberedFiles.h).

#pragma once

namespace command {

/// @brief Have SIGBUS reported as the failure of an input (kInput). The handler is called where a
/// page of a mapped file is not there any more, and for nothing else; other faults stay signals.
///
/// Exceptions that reach std::terminate are reported from the program's first instruction on, before
/// any library has started: OpenVDB's logging starts threads before main(). That needs no call. One
/// that nobody can name any more is called a lack of memory (kInput) if memory has been refused.
void catchLostPages();

/// @brief Have the program end (kInterrupted) a second after it was asked to stop, if it has not
/// stopped by then: it may be in a library that asks nobody, or give back gigabytes.
void endOverdueStops();
/// From here on everything is done, and such an end is a success (kOk).
void noteAllIsDone() noexcept;
/// Called when a stop is asked for; may be called by the handler of a signal.
void startCountdown() noexcept;
/// As long as one lives the program goes on nevertheless: files are about to take their places, all
/// of them or none.
class Uninterrupted {
public:
    Uninterrupted();
    Uninterrupted(const Uninterrupted&) = delete;
    Uninterrupted& operator=(const Uninterrupted&) = delete;
    ~Uninterrupted();
};

} // namespace command
