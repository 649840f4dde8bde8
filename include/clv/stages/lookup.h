// Evaluate where no weights are kept: irradiance at any point, interpolated between eight cells, as cpu/evaluate.h does.
//
// A shader defines, before it includes this: uint clvReadTable(uint cell), ClvSplit clvReadSplit(uint index), ClvSlot clvReadSlot(uint
// slot), and vec4 clvReadHistory(uint row), four numbers of the records.
#ifndef CLV_STAGES_LOOKUP_H
#define CLV_STAGES_LOOKUP_H
#include "evaluate.h"
#include "find_slot.h"
#include "read_record.h"
CLV_NAMESPACE_BEGIN

// Where a receiver reads from: the cell around which interpolation runs, its slot or kClvNoSlot, and the point on which it is centred.
struct ClvHub {
    ivec3 cell;
    uint slot;
    vec3 center;  // m
};

struct ClvLookup {
    vec3 light;    // sum of w times the record, read for the normal, W m
    float volume;  // sum of w times the open volume, m^3
};

// What a lookup knows of the records beside their place.
struct ClvRecordFormat {
    uint storage;
    uint channels;
    uint stride;
};

// The slot that holds `position` in this cell, or kClvNoSlot.
CLV_READER_FN uint clvSlotInCell(CLV_READER ClvVolume volume, ivec3 cell, vec3 position) {
    if (clvCellInside(volume, cell) == 0) return kClvNoSlot;
    return clvSlotAtPosition(CLV_PASS_READER CLV_READ clvReadTable(clvCellIndex(volume, cell)), position);
}

// First slot and number of slots of a cell whose table entry is not kClvNoSlot.
CLV_READER_FN uvec2 clvSlotsOfCell(CLV_READER uint entry) {
    if (!clvIsSplit(entry)) return uvec2(entry, 1u);
    ClvSplit split = CLV_READ clvReadSplit(entry & ~kClvSplitBit);
    return uvec2(split.firstSlot, split.slotCount);
}

// Whether a slot sees slot `ordinal` of the neighbour at `step`.
CLV_FN bool clvSlotSees(ClvSlot slot, ivec3 step, uint ordinal) { return (slot.visible[int(ordinal)] & clvNeighbourBit(step)) != 0u; }

// Half a cell in front of the surface, unless a wall stands between: then the surface's own cell.
CLV_READER_FN ClvHub clvFindHub(CLV_READER ClvVolume volume, ClvReceiver receiver) {
    ClvHub ahead;
    ahead.center = receiver.position + receiver.normal * (kClvLookupOffset * volume.cellSize);
    ahead.cell = clvClampCell(volume, clvCellFromPosition(volume, ahead.center));
    ahead.slot = clvSlotInCell(CLV_PASS_READER volume, ahead.cell, ahead.center);
    ClvHub own;
    own.center = receiver.position + receiver.normal * (kClvHomeOffset * volume.cellSize);
    own.cell = clvClampCell(volume, clvCellFromPosition(volume, own.center));
    ivec3 step = ahead.cell - own.cell;
    if (step.x == 0 && step.y == 0 && step.z == 0) return ahead;
    own.slot = clvSlotInCell(CLV_PASS_READER volume, own.cell, receiver.position + receiver.normal * (kClvSideOffset * volume.cellSize));
    if (own.slot == kClvNoSlot) return ahead;
    if (ahead.slot == kClvNoSlot) return own;
    ClvSlot ownSlot = CLV_READ clvReadSlot(own.slot);
    ClvSlot aheadSlot = CLV_READ clvReadSlot(ahead.slot);
    // A sliver of open space in front of the surface may have no slot of its own: what the cell has then lies behind the receiver.
    if (clvInFront(receiver, ownSlot.openCentroid) == 0 && clvInFront(receiver, aheadSlot.openCentroid) == 1) return ahead;
    uvec2 slots = clvSlotsOfCell(CLV_PASS_READER CLV_READ clvReadTable(clvCellIndex(volume, ahead.cell)));
    if (clvSlotSees(ownSlot, step, ahead.slot - slots.x)) return ahead;
    return own;
}

CLV_READER_FN void clvAddSlot(CLV_READER CLV_INOUT(ClvLookup) sum, ClvRecordFormat format, ClvCoefficients read, uint firstRecord, uint slot, float openVolume, float weight) {
    sum.light += clvReadRecord(CLV_PASS_READER firstRecord + slot, format.storage, format.channels, format.stride, read) * weight;
    sum.volume += openVolume * weight;
}

// Irradiance, W/m^2, from the records of a half, which begin at firstRecord. read: coefficients for the receiver's normal.
CLV_READER_FN vec3 clvIrradianceAt(CLV_READER ClvVolume volume, ClvReceiver receiver, ClvRecordFormat format, ClvCoefficients read, uint firstRecord) {
    ClvLookup sum;
    sum.light = vec3(0.0f, 0.0f, 0.0f);
    sum.volume = 0.0f;
    ClvHub hub = clvFindHub(CLV_PASS_READER volume, receiver);
    ClvSlot hubSlot = CLV_READ clvReadSlot(hub.slot == kClvNoSlot ? 0u : hub.slot);
    vec3 fromCenter = (hub.center - clvCellCenter(volume, hub.cell)) * (1.0f / volume.cellSize);
    // From the cell whose centre is below the point to the next.
    ivec3 low = ivec3(fromCenter.x < 0.0f ? -1 : 0, fromCenter.y < 0.0f ? -1 : 0, fromCenter.z < 0.0f ? -1 : 0);
    for (int k = 0; k < 8; ++k) {
        ivec3 step = low + ivec3(k % 2, k / 2 % 2, k / 4);
        ivec3 cell = hub.cell + step;
        float weight = clvLookupWeight(kClvLookupTrilinear, vec3(float(step.x), float(step.y), float(step.z)) - fromCenter);
        uint entry = clvCellInside(volume, cell) == 1 && weight > 0.0f ? CLV_READ clvReadTable(clvCellIndex(volume, clvClampCell(volume, cell))) : kClvNoSlot;
        uvec2 slots = uvec2(0u, 0u);
        if (entry != kClvNoSlot) slots = clvSlotsOfCell(CLV_PASS_READER entry);
        for (uint i = 0u; i < slots.y; ++i) {
            ClvSlot slot = CLV_READ clvReadSlot(slots.x + i);
            bool inSight = hub.slot == kClvNoSlot || clvSlotSees(hubSlot, step, i);
            float share = inSight && clvInFront(receiver, slot.openCentroid) == 1 ? weight : 0.0f;
            clvAddSlot(CLV_PASS_READER sum, format, read, firstRecord, slots.x + i, slot.openVolume, share);
        }
    }
    // Where everything was culled, the hub alone, whichever side its centroid lies on.
    if (!(sum.volume > 0.0f) && hub.slot != kClvNoSlot) clvAddSlot(CLV_PASS_READER sum, format, read, firstRecord, hub.slot, hubSlot.openVolume, 1.0f);
    return clvIrradianceFromSum(sum.light * (sum.volume > 0.0f ? 1.0f / sum.volume : 0.0f));
}

CLV_NAMESPACE_END
#endif
