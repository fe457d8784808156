// SPDX-License-Identifier: Apache-2.0
/// @file Action.h
/// @brief What an action is, and one call of it on a command line.
///
/// The specification of an action has its name, options and documentation, how it is checked and how
/// it is run. The parser and -help need nothing else.

#pragma once

#include "base/Errors.h"
#include "base/ProgressShare.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace command {

class ActionCall;
class Plan;
struct Session;

enum class OptionKind {
    Text,
    List,    ///< texts with commas between; a main option of this kind takes any number of tokens.
             ///< The name of a file that exists is one text, even if it has commas.
    Flag,    ///< 1|0|true|false|yes|no|on|off
    Integer, ///< within [lowest, highest]
    Real,    ///< within [lowest, highest]
    Length,  ///< the same, in world units; or with a unit behind it, in metres
    Vector,  ///< three numbers with commas between
    Choice,  ///< one of `choices`
    Words    ///< texts as they are, with their commas: the main option takes any number of tokens
};

/// What an action does to those after it, up to the -end that belongs to it.
enum class Block { None, For, Each, Files, If, End };

struct OptionSpec {
    std::string name;
    OptionKind kind = OptionKind::Text;
    std::string fallback; ///< the default as it would be typed; empty if there is none
    std::string doc;
    double lowest = -std::numeric_limits<double>::infinity();
    double highest = std::numeric_limits<double>::infinity();
    std::vector<std::string> choices = {};
    bool isPercent = false; ///< a number without a sign behind it

    bool hasChoice(const std::string& choice) const
    {
        return std::find(choices.begin(), choices.end(), choice) != choices.end();
    }
    /// @return whether @a prefix stands for it. A `name` takes two letters: n is a number to many; so do
    ///         `frames`: f was `files` before there were any.
    bool isMeantBy(const std::string& prefix) const;
};

/// @name Short forms for the tables of options
/// @{
OptionSpec text(const std::string& name, const std::string& fallback, const std::string& doc);
OptionSpec list(const std::string& name, const std::string& fallback, const std::string& doc);
OptionSpec words(const std::string& name, const std::string& doc);
OptionSpec flag(const std::string& name, bool fallback, const std::string& doc);
OptionSpec integer(const std::string& name, const std::string& fallback, int64_t lowest,
    int64_t highest, const std::string& doc);
OptionSpec real(const std::string& name, const std::string& fallback, double lowest, double highest,
    const std::string& doc);
OptionSpec length(const std::string& name, const std::string& fallback, double lowest,
    double highest, const std::string& doc);
OptionSpec vector(const std::string& name, const std::string& fallback, const std::string& doc);
OptionSpec choice(const std::string& name, const std::vector<std::string>& choices,
    const std::string& doc); ///< the first choice is the default
/// Options of nearly every action.
OptionSpec vdbOption(const std::string& what);
OptionSpec keepOption();
OptionSpec nameOption(const std::string& fallback, const std::string& doc);
/// @}

struct ActionSpec {
    std::string name;
    std::string alias;      ///< may be empty
    std::string mainOption; ///< takes tokens without `=`; may be empty
    std::string doc;
    std::vector<OptionSpec> options = {};
    /// What else its help lists: terms, and what each is.
    std::vector<std::pair<std::string, std::string>> more = {};
    std::string numberOption = {}; ///< what a number is likely meant for that mainOption refuses

    Block block = Block::None;
    bool isLiteral = false;    ///< its values are no expressions
    bool anyName = false;      ///< `NAME=value` is a word of its first option, whatever the name
    bool once = false;         ///< may stand on the line only once
    bool quiet = false;        ///< gets no timing line
    bool isSource = false;     ///< puts something new on the stack, as -read does
    bool needsInput = true;    ///< a source has to come before; a source itself needs none
    bool isForLater = false;   ///< lost unless a later action gives out what it made
    bool writesEmpty = false;  ///< does its part for a frame without an object
    bool givesOut = false;     ///< writes or prints what is on the stack
    ExitCode failure = kInput; ///< exit code for an exception that has none

    /// Checks what can be checked before any work; may be empty.
    std::function<void(const ActionCall&, Plan&)> check = {};
    std::function<void(const ActionCall&, Session&)> run = {};
    /// What is done in the place of `run` where there is no object, with empty=write; may be empty.
    std::function<void(const ActionCall&, Session&)> runEmpty = {};
    /// What is known of how long it takes; may be empty.
    std::function<LongWork(const ActionCall&)> work = {};

    const OptionSpec* option(const std::string& optionName) const;
};

/// @return an action that needs no input and gets no timing line; its `run` is still empty.
ActionSpec smallAction(const std::string& name, const std::string& doc);

/// @return whether a value as it was typed is one yet to be found: it has an expression, or a place for
///         a frame number, and is not the name of a file that exists.
bool isOpen(const ActionSpec& action, const OptionSpec& option, const std::string& typed);

/// One action of a command line. Its values have been checked against its options, but for open ones.
class ActionCall {
public:
    using Evaluate = std::function<std::string(const OptionSpec&, const std::string& typed)>;

    explicit ActionCall(const ActionSpec& spec) : mSpec(&spec) {}

    const ActionSpec& spec() const { return *mSpec; }
    /// @return `-name`, for messages.
    std::string label() const { return "-" + mSpec->name; }
    /// @return the same, and before it the line of the file of -config that it stands in.
    std::string where() const { return mOrigin + label(); }
    /// @param origin  goes before those that are there
    void addOrigin(const std::string& origin) { mOrigin = origin + mOrigin; }
    /// @return the action as it was typed, on one line.
    std::string typed() const;

    bool given(const std::string& option) const { return mValues.count(option) > 0; }
    /// @brief Give an option its value, or one more of a list.
    /// @throw CommandError (usage) that names the action, if it is not open and does not suit the option
    void give(const OptionSpec& option, const std::string& typed);

    /// @return whether a value is open.
    bool isOpen() const { return mIsOpen; }
    /// @return the call with a value for each that is open.
    /// @throw CommandError (usage) if it does not suit the option, and what @a evaluate throws
    ActionCall evaluated(const Evaluate& evaluate) const;
    struct Given {
        const OptionSpec* option;
        std::string typed;
        bool isOpen;
    };
    /// All values as they were typed, in that order.
    const std::vector<Given>& given() const { return mGiven; }

    /// @name The value of an option, or its default. Not to be asked for while it is open
    /// @{
    std::string text(const std::string& option) const;
    std::vector<std::string> list(const std::string& option) const;
    bool flag(const std::string& option) const;
    int64_t integer(const std::string& option) const;
    double real(const std::string& option) const;
    double length(const std::string& option) const;
    std::array<double, 3> vector(const std::string& option) const;
    /// @}

private:
    void setValue(const OptionSpec& option, const std::string& value);

    const ActionSpec* mSpec;
    std::string mOrigin;
    bool mIsOpen = false;
    std::vector<Given> mGiven;
    std::map<std::string, std::vector<std::string>> mValues; ///< one value, or those of a list
};

/// @return the three numbers of a text such as `1,0.5,-2` or `(1,0.5,-2)`, or the unit vector of an axis of
/// that name (`z`); nothing if it is neither.
std::optional<std::array<double, 3>> parseVector(const std::string& typed);

/// @brief Check one value against its option.
/// @throw CommandError (usage) naming the option, the value and what is allowed
void checkValue(const OptionSpec& option, const std::string& value);

/// @return all actions, in the order in which -help lists them.
const std::vector<ActionSpec>& actionTable();

/// @return the action of that name or alias, or null.
const ActionSpec* findAction(const std::string& name);

} // namespace command
