// The slot that holds a position, found in a level's buffers.
//
// A shader defines, before it includes this: ClvSplit clvReadSplit(uint index).
#ifndef CLV_STAGES_FIND_SLOT_H
#define CLV_STAGES_FIND_SLOT_H
#include "../data/light_volume.h"
CLV_NAMESPACE_BEGIN

CLV_FN bool clvIsSplit(uint entry) { return entry != kClvNoSlot && (entry & kClvSplitBit) != 0u; }

// The side of a split on which the position lies: a slot, or a further split. Without a branch, because it cannot be predicted.
CLV_FN uint clvSideOfSplit(ClvSplit split, vec3 position) {
    return split.back ^ ((split.front ^ split.back) & (0u - uint(clvInFrontOfSplit(split, position))));
}

// The slot of a cell of this table entry that holds the position; kClvNoSlot stays kClvNoSlot.
CLV_READER_FN uint clvSlotAtPosition(CLV_READER uint entry, vec3 position) {
    for (int depth = 0; depth < kClvMostSplits && clvIsSplit(entry); ++depth) {
        entry = clvSideOfSplit(CLV_READ clvReadSplit(entry & ~kClvSplitBit), position);
    }
    return entry;
}

CLV_NAMESPACE_END
#endif
