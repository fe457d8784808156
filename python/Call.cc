// SPDX-License-Identifier: Apache-2.0
#include "Call.h"

#include "base/Stop.h"
#include "Errors.h"

#include <tbb/task_arena.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <string>
#include <thread>

namespace py = pybind11;

namespace binding {

namespace {

using namespace std::chrono_literals;

constexpr auto kLook = 50ms;  // for signals
constexpr auto kTell = 100ms; // from one call of `progress` to the next

/// What there is to tell of the work.
struct News {
    double done = 0;
    std::string stage;
};

/// Asked from many threads; told from the work's. Percentages of stages within a stage are details.
class CallInterrupter : public Interrupter {
public:
    explicit CallInterrupter(const command::LongWork& work) : mShare(work) {}

    void start(const char* name) override
    {
        const std::lock_guard<std::mutex> lock(mMutex);
        if (mDepth++ > 0) return;
        mNews.stage = name ? name : "";
        mShare.startStage(mNews.stage);
    }
    void end() override
    {
        const std::lock_guard<std::mutex> lock(mMutex);
        if (--mDepth == 0) mShare.endStage();
    }
    bool wasInterrupted(int percent) override
    {
        if (percent >= 0 && percent != mPercent.load(std::memory_order_relaxed)) {
            const std::unique_lock<std::mutex> lock(mMutex, std::try_to_lock);
            if (lock && mDepth <= 1) {
                mPercent = percent;
                mShare.report(percent);
            }
        }
        return mStop.load(std::memory_order_relaxed);
    }

    void stop() { mStop = true; }
    bool isStopped() const { return mStop.load(std::memory_order_relaxed); }

    News news()
    {
        const std::lock_guard<std::mutex> lock(mMutex);
        mNews.done = mShare.done();
        return mNews;
    }

    void finish()
    {
        const std::lock_guard<std::mutex> lock(mMutex);
        mIsFinished = true;
        mFinished.notify_all();
    }
    /// @return whether the work has ended, within that time.
    bool waitFor(std::chrono::milliseconds time)
    {
        std::unique_lock<std::mutex> lock(mMutex);
        return mFinished.wait_for(lock, time, [this] { return mIsFinished; });
    }

private:
    std::atomic<bool> mStop{false};
    std::atomic<int> mPercent{-1};
    std::mutex mMutex; ///< guards what follows
    std::condition_variable mFinished;
    command::ProgressShare mShare;
    News mNews;
    int mDepth = 0;
    bool mIsFinished = false;
};

thread_local CallInterrupter* tCurrent = nullptr; // of the thread that does the work

bool isCurrentStopped() { return tCurrent && tCurrent->isStopped(); }

void runInArena(int threads, const std::function<void()>& work)
{
    if (threads == 0) return work();
    tbb::task_arena(threads).execute(work);
}

/// Tells `progress` what is new, at most every kTell.
class Teller {
public:
    explicit Teller(const py::object& progress) : mProgress(progress) {}

    /// With the GIL. @throw pybind11::error_already_set
    void tell(const News& news)
    {
        const auto now = std::chrono::steady_clock::now();
        if (mProgress.is_none() || now - mLast < kTell) return;
        mLast = now;
        mProgress(news.done, news.stage);
    }

private:
    const py::object& mProgress;
    std::chrono::steady_clock::time_point mLast = std::chrono::steady_clock::now();
};

/// Waits for the work with the GIL released, and takes it for a moment to look after Python.
/// @return what Python had to say against going on, or null.
std::exception_ptr attend(CallInterrupter& call, Teller& teller)
{
    std::exception_ptr objection;
    while (!call.waitFor(kLook)) {
        if (call.isStopped()) continue;
        const py::gil_scoped_acquire python;
        try {
            if (PyErr_CheckSignals() != 0) throw py::error_already_set();
            teller.tell(call.news());
        } catch (...) {
            objection = std::current_exception();
            call.stop();
        }
    }
    return objection;
}

void requireSense(const CallSettings& settings)
{
    if (settings.threads < 0) {
        throw InputError("threads=" + std::to_string(settings.threads)
            + " is out of range: it takes 1 or more, or None for all cores");
    }
    if (!settings.progress.is_none() && !PyCallable_Check(settings.progress.ptr())) {
        throw py::type_error(std::string("progress must be a function or None, not ")
            + Py_TYPE(settings.progress.ptr())->tp_name);
    }
}

} // namespace

void runBriefly(const CallSettings& settings, const std::function<void(Interrupter*)>& work)
{
    if (!settings.progress.is_none()) return runCall(settings, work);
    requireSense(settings);
    const py::gil_scoped_release others;
    runInArena(settings.threads, [&] { work(nullptr); });
}

void runCall(const CallSettings& settings, const std::function<void(Interrupter*)>& work)
{
    requireSense(settings);
    command::setStopQuestion(isCurrentStopped);
    CallInterrupter call(settings.work);
    Teller teller(settings.progress);
    std::exception_ptr failure, objection;
    {
        const py::gil_scoped_release others;
        std::thread worker([&] {
            tCurrent = &call;
            try {
                runInArena(settings.threads, [&] { work(&call); });
            } catch (...) {
                failure = std::current_exception();
            }
            call.finish();
        });
        objection = attend(call, teller);
        worker.join();
    }
    if (objection) std::rethrow_exception(objection);
    if (failure) std::rethrow_exception(failure);
    if (!settings.progress.is_none()) settings.progress(1.0, "");
}

} // namespace binding
