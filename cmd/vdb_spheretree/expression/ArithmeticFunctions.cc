// SPDX-License-Identifier: Apache-2.0
/// @file ArithmeticFunctions.cc
/// @brief Numbers to numbers. Whole numbers give whole numbers, as far as vdb_tool's do.

#include "Functions.h"

#include "base/Errors.h"

#include <cmath>
#include <limits>

namespace command {

namespace {

constexpr float kPi = 3.14159265358979f;

[[noreturn]] void overflow() { throwUsage("the result is too large for a whole number"); }

int64_t sum(int64_t a, int64_t b)
{
    int64_t result;
    if (__builtin_add_overflow(a, b, &result)) overflow();
    return result;
}

int64_t difference(int64_t a, int64_t b)
{
    int64_t result;
    if (__builtin_sub_overflow(a, b, &result)) overflow();
    return result;
}

int64_t product(int64_t a, int64_t b)
{
    int64_t result;
    if (__builtin_mul_overflow(a, b, &result)) overflow();
    return result;
}

int64_t quotient(int64_t a, int64_t b)
{
    if (b == 0) throwUsage("a number is divided by zero");
    if (b == -1) return difference(0, a);
    return a / b;
}

/// Of a real result, what is before the point.
int64_t wholePart(double number)
{
    constexpr double kLimit = 9.2e18;
    if (!(std::abs(number) < kLimit)) overflow();
    return int64_t(number);
}

int64_t power(int64_t a, int64_t b) { return wholePart(std::pow(double(a), double(b))); }

/// Both are whole, or the result is real.
template <typename Whole, typename Real>
Function binary(
    const std::string& name, const std::string& doc, const Whole& whole, const Real& real)
{
    return {name, 2, doc, [whole, real](Evaluation& e) {
                const Number b = e.operands.popNumber(), a = e.operands.popNumber();
                if (isWhole(a) && isWhole(b)) {
                    e.operands.push(Number(whole(std::get<int64_t>(a), std::get<int64_t>(b))));
                } else {
                    e.operands.push(Number(float(real(realOf(a), realOf(b)))));
                }
            }};
}

template <typename Whole, typename Real>
Function unary(
    const std::string& name, const std::string& doc, const Whole& whole, const Real& real)
{
    return {name, 1, doc, [whole, real](Evaluation& e) {
                const Number a = e.operands.popNumber();
                if (isWhole(a)) e.operands.push(Number(whole(std::get<int64_t>(a))));
                else e.operands.push(Number(real(std::get<float>(a))));
            }};
}

/// The result is real, whatever the operand.
Function real(const std::string& name, const std::string& doc, float (*function)(float))
{
    return {name, 1, doc, [function](Evaluation& e) {
                e.operands.push(Number(function(realOf(e.operands.popNumber()))));
            }};
}

float nonzero(float number)
{
    if (number == 0) throwUsage("a number is divided by zero");
    return number;
}

std::vector<Function> basicFunctions()
{
    const auto sign = [](auto a) { return int64_t((a > 0) - (a < 0)); };
    return {
        binary("+", "{1:2:+} -> 3", sum, [](float a, float b) { return a + b; }),
        binary("-", "{1:2:-} -> -1", difference, [](float a, float b) { return a - b; }),
        binary("*", "{1:2:*} -> 2", product, [](float a, float b) { return a * b; }),
        binary("/", "{7:2:/} -> 3 and {7.0:2:/} -> 3.500000", quotient,
            [](float a, float b) { return a / nonzero(b); }),
        unary(
            "++", "{1:++} -> 2", [](int64_t a) { return sum(a, 1); },
            [](float a) { return a + 1; }),
        unary(
            "--", "{1:--} -> 0", [](int64_t a) { return difference(a, 1); },
            [](float a) { return a - 1; }),
        binary(
            "min", "{1:2:min} -> 1", [](int64_t a, int64_t b) { return std::min(a, b); },
            [](float a, float b) { return std::min(a, b); }),
        binary(
            "max", "{1:2:max} -> 2", [](int64_t a, int64_t b) { return std::max(a, b); },
            [](float a, float b) { return std::max(a, b); }),
        unary(
            "abs", "{-1:abs} -> 1", [](int64_t a) { return a < 0 ? difference(0, a) : a; },
            [](float a) { return std::abs(a); }),
        unary(
            "neg", "{1:neg} -> -1", [](int64_t a) { return difference(0, a); },
            [](float a) { return -a; }),
        unary("sign", "{-2:sign} -> -1", sign, sign),
        {"to_int", 1, "{1.2:to_int} -> 1",
            [](Evaluation& e) {
                e.operands.push(Number(wholePart(realOf(e.operands.popNumber()))));
            }},
    };
}

std::vector<Function> realFunctions()
{
    return {
        real("to_float", "{1:to_float} -> 1.000000", [](float a) { return a; }),
        real("inv", "{5:inv} -> 0.200000", [](float a) { return 1 / nonzero(a); }),
        real("floor", "{0.5:floor} -> 0.000000", [](float a) { return std::floor(a); }),
        real("ceil", "{0.5:ceil} -> 1.000000", [](float a) { return std::ceil(a); }),
        real("sqrt", "{4:sqrt} -> 2.000000", [](float a) { return std::sqrt(a); }),
        real("exp", "{1:exp} -> 2.718282", [](float a) { return std::exp(a); }),
        real("ln", "{1:ln} -> 0.000000", [](float a) { return std::log(a); }),
        real("log", "of base 10: {100:log} -> 2.000000", [](float a) { return std::log10(a); }),
        real("sin", "{0:sin} -> 0.000000", [](float a) { return std::sin(a); }),
        real("cos", "{$pi:cos} -> -1.000000", [](float a) { return std::cos(a); }),
        real("tan", "{0:tan} -> 0.000000", [](float a) { return std::tan(a); }),
        real("asin", "{1:asin} -> 1.570796", [](float a) { return std::asin(a); }),
        real("acos", "{1:acos} -> 0.000000", [](float a) { return std::acos(a); }),
        real("atan", "{1:atan} -> 0.785398", [](float a) { return std::atan(a); }),
        real("d2r", "degrees to radians: {180:d2r} -> 3.141593",
            [](float a) { return a * kPi / 180; }),
        real("r2d", "radians to degrees: {1:r2d} -> 57.295776",
            [](float a) { return a * 180 / kPi; }),
    };
}

} // namespace

std::vector<Function> arithmeticFunctions()
{
    std::vector<Function> all = basicFunctions();
    all.push_back(
        binary("pow", "{2:3:pow} -> 8", power, [](float a, float b) { return std::pow(a, b); }));
    all.push_back(unary(
        "pow2", "{3:pow2} -> 9", [](int64_t a) { return product(a, a); },
        [](float a) { return a * a; }));
    all.push_back(unary(
        "pow3", "{3:pow3} -> 27", [](int64_t a) { return product(a, product(a, a)); },
        [](float a) { return a * a * a; }));
    for (const Function& function : realFunctions()) all.push_back(function);
    return all;
}

} // namespace command
