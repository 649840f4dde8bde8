// Indices of an array, handed out in short runs and taken back: where cells keep their slots and splits.
#ifndef CLV_CPU_BLOCK_POOL_H
#define CLV_CPU_BLOCK_POOL_H
#include <cstddef>
#include <vector>

#include "../lang.h"

namespace clv {

class BlockPool {
public:
    // Runs are 1 to longestRun indices long.
    explicit BlockPool(uint longestRun) : free_(longestRun + 1) {}

    // The first of `count` indices in a row. A run that was given back goes out again as a run of the same length, so runs never
    // break into pieces too short to be of use.
    uint take(uint count) {
        if (free_[count].empty()) {
            const uint first = size_;
            size_ += count;
            return first;
        }
        const uint first = free_[count].back();
        free_[count].pop_back();
        return first;
    }
    void giveBack(uint first, uint count) { free_[count].push_back(first); }

    // Takes all runs back, without asking for memory.
    void clear() {
        for (std::vector<uint>& runs : free_) runs.clear();
        size_ = 0;
    }

    // One above the highest index ever handed out: what an array must hold.
    std::size_t size() const { return size_; }

private:
    std::vector<std::vector<uint>> free_;  // first indices, by length
    uint size_ = 0;
};

}  // namespace clv
#endif
