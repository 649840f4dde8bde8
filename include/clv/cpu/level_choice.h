// Levels come and go while rays come: a finer one joins while the finest is the best, and those that err clearly more are dropped.
#ifndef CLV_CPU_LEVEL_CHOICE_H
#define CLV_CPU_LEVEL_CHOICE_H
#include "resolution.h"

namespace clv {

// The levels in play, coarse to fine, as their owner keeps them.
class LevelsInPlay {
public:
    virtual ~LevelsInPlay() = default;
    virtual int count() const = 0;
    // Merged into a level so far.
    virtual double rays(int level) const = 0;
    // What both halves of a level say at the receivers that judge.
    virtual void estimate(int level, HalfEstimates& estimates) const = 0;
    // The next finer level joins, with the light of the last rays; false where there is none.
    virtual bool addFiner() = 0;
    // In what is shown; 0: not at all.
    virtual void setWeight(int level, double weight) = 0;
    virtual void drop(int level) = 0;
};

class LevelChoice {
public:
    // Foretells the errors once `target` rays are in, of which `done` are; both > 0. Weighs the levels accordingly. From the first time
    // on that the choice is to be `settled`, no level joins any more, and levels leave.
    void judge(LevelsInPlay& levels, double done, double target, bool settled) {
        if (settled_ && levels.count() == 1) return;
        LevelErrors errors = foretell(levels, done, target);
        while (!settled_ && bestLevel(errors) + 1 == errors.count && levels.addFiner()) errors = foretell(levels, done, target);
        const LevelMix mix = chooseLevels(errors);
        for (int l = 0; l < errors.count; ++l) levels.setWeight(l, mix[l]);
        settled_ = settled_ || settled;
        for (int l = settled_ ? errors.count : 0; l-- > 0;) {
            if (mix[l] == 0.0 && !staysInPlay(errors, l)) levels.drop(l);
        }
    }
    bool settled() const { return settled_; }

private:
    LevelErrors foretell(const LevelsInPlay& levels, double done, double target) {
        estimates_.resize(std::size_t(levels.count()));
        factor_.clear();
        for (int l = 0; l < levels.count(); ++l) {
            levels.estimate(l, estimates_[std::size_t(l)]);
            // A level that joined late has missed the rays before it.
            const double missed = done - levels.rays(l);
            factor_.push_back(std::max(1.0, (target - missed) / levels.rays(l)));
        }
        return judgeLevels(estimates_).withRays(factor_);
    }

    std::vector<HalfEstimates> estimates_;
    std::vector<double> factor_;
    bool settled_ = false;
};

}  // namespace clv
#endif
