// SPDX-License-Identifier: Apache-2.0
#include "Script.h"

#include "base/Errors.h"
#include "expression/Number.h"
#include "Blocks.h"
#include "LoopValues.h"
#include "OpenCall.h"
#include "Sequence.h"

#include <algorithm>

namespace command {

namespace {

constexpr char kSequence[] = "frame"; ///< the variable of a loop without an -end

void addStored(const std::vector<Step>& steps, std::vector<std::string>& names)
{
    for (const Step& step : steps) {
        for (const Assignment& one : step.stored) names.push_back(one.first);
        for (const Frame& frame : step.frames) addStored(frame.steps, names);
    }
}

class Unroller {
public:
    explicit Unroller(const std::vector<ActionCall>& line) : mLine(line), mEnds(endsOfBlocks(line))
    {}

    Script run()
    {
        Script script;
        addSteps(0, mLine.size(), script.steps);
        mPlan.requireInputs();
        script.plan = std::move(mPlan);
        return script;
    }

private:
    struct Turn {
        std::string variable, value;
    };

    /// Adds what the actions from @a begin to before @a end do.
    void addSteps(size_t begin, size_t end, std::vector<Step>& steps)
    {
        for (size_t i = begin; i < end; ++i) {
            switch (mLine[i].spec().block) {
            case Block::None:
                if (const auto name = sequenceAt(i)) return addSequence(i, end, *name, steps);
                addAction(i, steps);
                break;
            case Block::If:
                addIf(i, steps);
                i = mEnds[i];
                break;
            default: addLoop(i, steps); i = mEnds[i];
            }
        }
    }

    /// Of actions and of turns.
    void countStep() { requireSteps(++mSteps); }

    void requireSteps(size_t steps) const
    {
        if (steps <= kMostSteps) return;
        throwUsage(
            "the loops of this line come to more than " + std::to_string(kMostSteps) + " actions");
    }

    Step stepOf(size_t place)
    {
        countStep();
        Step step{Step::Kind::Action, mLine[place]};
        step.place = place;
        step.number = number();
        step.isLost = isLost(place);
        if (!mTurns.empty()) step.call.addOrigin(frameName() + ": ");
        return step;
    }

    /// @return whether the values of the step's call could be found: else it is left open.
    bool close(Step& step)
    {
        if (!step.call.isOpen()) return true;
        const Variables before = mVariables;
        try {
            step.call = closedCall(step.call, mVariables, step.number, nullptr);
            step.stored = mVariables.takeAssigned();
            return true;
        } catch (const NeedsStack&) {
            mVariables = before;
            for (const auto& one : step.call.given()) {
                if (one.isOpen) setStoredUnknown(one.typed, mVariables);
            }
            return false;
        } catch (...) {
            rethrowNamed(step.call.where(), kUsage);
        }
    }

    void addAction(size_t place, std::vector<Step>& steps)
    {
        Step step = stepOf(place);
        if (step.call.given("frames") && !mInSequence) {
            throwUsage(step.call.where()
                + ": frames= is for a sequence, which has #### or %04d in the name of its files, "
                  "and is "
                  "not in a loop with a number of its own");
        }
        step.isChecked = close(step) && !mMayBeSkipped;
        if (step.isChecked) checkCall(step.call, mPlan);
        steps.push_back(std::move(step));
    }

    void addIf(size_t place, std::vector<Step>& steps)
    {
        Step step = stepOf(place);
        step.kind = Step::Kind::If;
        step.frames.emplace_back();
        std::vector<Step>& body = step.frames.back().steps;
        if (close(step)) {
            if (testOf(step.call)) addSteps(place + 1, mEnds[place], body);
        } else {
            addMaybe(place, body);
        }
        steps.push_back(std::move(step));
    }

    /// Adds what is done if the test of an -if holds, where that is not known yet.
    void addMaybe(size_t place, std::vector<Step>& body)
    {
        const bool before = std::exchange(mMayBeSkipped, true);
        addSteps(place + 1, mEnds[place], body);
        mMayBeSkipped = before;
        std::vector<std::string> stored;
        addStored(body, stored);
        for (const std::string& name : stored) mVariables.setUnknown(name);
    }

    void addLoop(size_t place, std::vector<Step>& steps)
    {
        Step step = stepOf(place);
        step.kind = Step::Kind::Loop;
        if (!close(step)) {
            throwUsage(step.call.where()
                + ": how often a loop turns must be known before any work, and this asks for what "
                  "will be "
                  "on the stack");
        }
        LoopValues loop;
        try {
            loop = loopValues(step.call);
            requireFree(loop.variable);
        } catch (...) {
            rethrowNamed(step.call.where(), kUsage);
        }
        if (loop.values.empty()) step.note = step.call.typed() + " has nothing to go through";
        addTurns(step, loop, place + 1, mEnds[place]);
        steps.push_back(std::move(step));
    }

    void requireFree(const std::string& variable) const
    {
        for (const Turn& turn : mTurns) {
            if (turn.variable != variable) continue;
            throwUsage(
                "the variable " + variable + " is that of a loop around this one: take another");
        }
    }

    /// @return how many steps a turn has at least: itself, and one an action or block.
    size_t leastSteps(size_t begin, size_t end) const
    {
        size_t steps = 1;
        for (size_t i = begin; i < end; ++i, ++steps) {
            if (mLine[i].spec().block != Block::None) i = mEnds[i];
        }
        return steps;
    }

    void addTurns(Step& step, const LoopValues& loop, size_t begin, size_t end)
    {
        // Files of every turn are looked up on the way: seconds, where the loop is too long anyway.
        requireSteps(mSteps + loop.values.size() * leastSteps(begin, end));
        step.variable = loop.variable;
        for (const std::string& value : loop.values) {
            countStep();
            step.frames.emplace_back();
            Frame& frame = step.frames.back();
            mTurns.push_back({loop.variable, value});
            frame.name = frameName();
            mPlan.setFrame(frame.name);
            mVariables.set(loop.variable, value);
            mVariables.set("#" + loop.variable, std::to_string(step.frames.size() - 1));
            frame.variables = mVariables.takeAssigned();
            addSteps(begin, end, frame.steps);
            mTurns.pop_back();
        }
        mVariables.erase(loop.variable);
        mVariables.erase("#" + loop.variable);
        mPlan.setFrame(frameName());
    }

    std::optional<std::string> sequenceAt(size_t place) const
    {
        if (number()) return {}; // that of a loop is meant
        try {
            return sequenceName(mLine[place], mVariables);
        } catch (...) {
            rethrowNamed(mLine[place].where(), kUsage);
        }
    }

    /// From here to the end of the line, or of the loop around, all is done for each frame.
    void addSequence(size_t place, size_t end, const std::string& name, std::vector<Step>& steps)
    {
        Step step = stepOf(place);
        step.kind = Step::Kind::Loop;
        step.isSequence = true;
        LoopValues loop{kSequence, {}};
        try {
            requireFree(loop.variable);
            const SequenceFrames found = framesOfSequence(step.call, name, mVariables);
            for (const int64_t frame : found.frames) loop.values.push_back(std::to_string(frame));
            step.note = found.gaps;
        } catch (const NeedsStack&) {
            throwUsage(step.call.where()
                + ": frames= must be known before any work, and this asks for what will be on the "
                  "stack");
        } catch (...) {
            rethrowNamed(step.call.where(), kUsage);
        }
        mInSequence = true;
        addTurns(step, loop, place, end);
        mInSequence = false;
        steps.push_back(std::move(step));
    }

    std::optional<int64_t> number() const
    {
        for (auto turn = mTurns.rbegin(); turn != mTurns.rend(); ++turn) {
            const auto value = numberOf(turn->value);
            if (value && isWhole(*value)) return std::get<int64_t>(*value);
        }
        return {};
    }

    std::string frameName() const
    {
        std::string name;
        for (const Turn& turn : mTurns) {
            name += (name.empty() ? "" : ", ") + turn.variable + "=" + oneLine(turn.value, 60);
        }
        return name;
    }

    bool isLost(size_t place) const
    {
        return mLine[place].spec().isForLater
            && std::none_of(mLine.begin() + std::ptrdiff_t(place), mLine.end(),
                [](const ActionCall& later) { return later.spec().givesOut; });
    }

    const std::vector<ActionCall>& mLine;
    const std::vector<size_t> mEnds;
    Variables mVariables;
    Plan mPlan;
    std::vector<Turn> mTurns; ///< of the loops around, the innermost last
    size_t mSteps = 0;
    bool mMayBeSkipped = false; ///< within an -if whose test is not known
    bool mInSequence = false;
};

} // namespace

Script scriptOf(const std::vector<ActionCall>& line) { return Unroller(line).run(); }

} // namespace command
