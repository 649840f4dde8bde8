// Who may read a volume's light: what a method must keep, and what it may leave out.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "benchmarks/baselines/method.h"
#include "clv/stages/evaluate.h"

namespace clv {

// The same choice for every method with a grid, so that cells and probes that nobody reads are left out by all or by none.
enum class Readers {
    receivers,  // the points that the method was prepared for
    surfaces,   // any point of a surface: a camera may move, the scene stands still
    anywhere,   // moving objects too
};
std::string readersName(Readers readers);

// Points that stand for all readers, the receivers among them; none where anybody may read.
std::vector<ClvReceiver> readingPoints(Readers readers, const MethodWorld& world, std::span<const ReferencePoint> receivers);

}  // namespace clv
