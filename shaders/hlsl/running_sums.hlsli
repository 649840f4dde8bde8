// Running sums of many weights by one work group. The entry point defines before: float readWeight(uint i) and
// void writeSum(uint i, float sum), which may take the place of weight i - 1.
groupshared float partialSums[CLV_GROUP_SIZE];

// Writes count + 1 sums of readWeight(i), from 0 to 1; 1 throughout where there is no weight. Returns what the weights add up to.
float writeRunningSums(uint thread, uint count) {
    uint each = (count + CLV_GROUP_SIZE - 1) / CLV_GROUP_SIZE;
    uint first = min(thread * each, count);
    uint end = min(first + each, count);
    float sum = 0.0;
    for (uint i = first; i < end; ++i) sum += readWeight(i);
    partialSums[thread] = sum;
    GroupMemoryBarrierWithGroupSync();
    float before = 0.0;
    float total = 0.0;
    for (uint k = 0; k < CLV_GROUP_SIZE; ++k) {
        if (k == thread) before = total;
        total += partialSums[k];
    }
    // Added up as above, so that sums never fall from one thread to the next and end with 1.
    sum = 0.0;
    for (uint i = first; i < end; ++i) {
        sum += readWeight(i);
        writeSum(i + 1, total > 0.0 ? (before + sum) / total : 1.0);
    }
    if (thread == 0) writeSum(0, total > 0.0 ? 0.0 : 1.0);
    return total;
}
