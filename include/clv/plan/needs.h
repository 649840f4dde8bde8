// What a scene needs of the library, and what is left out because it does not.
#ifndef CLV_PLAN_NEEDS_H
#define CLV_PLAN_NEEDS_H
#include <string>
#include <vector>

#include "../lang.h"

namespace clv {

struct SceneFacts {
    bool greyLights = false;      // every light has three equal channels
    bool greySurfaces = false;    // every albedo has three equal channels
    bool anyLight = true;         // some light has an intensity above 0
    bool lightsMove = false;      // some light moves, turns or changes
    bool cameraMoves = false;     // the volumes follow a camera; otherwise one volume holds the scene
    int cascadesInBounds = 1;     // cascades that still add space inside the scene's bounds
    bool allBounces = false;
    bool resolutionGiven = false;
    mat3 frame{1.0f};             // see directionFrame
};

// One decision and its reason, for people.
struct Decision {
    std::string name;
    bool needed = true;
    std::string reason;
};

struct Needs {
    bool stages = true;      // any at all
    int channels = 3;        // 1: one channel serves all three
    bool dynamicity = true;  // a value a side and slot, and its part of inject and merge
    bool scrolling = true;   // toroidal addressing of volumes that follow the camera
    int cascades = 1;
    int halves = 2;          // of the rays, for judging resolutions
    bool feedback = true;    // surfaces send on the light that they receive
    mat3 frame{1.0f};        // in which cells keep directions
    std::vector<Decision> decisions;
};

inline Needs planNeeds(const SceneFacts& facts) {
    Needs needs;
    auto decide = [&](const char* name, bool needed, const char* because, const char* whyNot) {
        needs.decisions.push_back({name, needed, needed ? because : whyNot});
        return needed;
    };
    needs.stages = decide("stages", facts.anyLight, "some light is on", "no light is on: the answer is zero, nothing is traced or allocated");
    if (!needs.stages) return needs;
    const bool grey = facts.greyLights && facts.greySurfaces;
    needs.channels = decide("colour", !grey, "lights or surfaces have colour", "lights and surfaces are grey: one channel serves all three") ? 3 : 1;
    needs.dynamicity = decide("dynamicity", facts.lightsMove, "lights move", "no light moves: history is a plain mean");
    needs.scrolling = decide("scrolling", facts.cameraMoves, "the volumes follow the camera", "no camera moves: one volume holds the scene");
    const bool moreCascades = facts.cameraMoves && facts.cascadesInBounds > 1;
    needs.cascades = decide("further cascades", moreCascades, "the scene reaches beyond the first one", "the first volume holds the scene") ? facts.cascadesInBounds : 1;
    needs.halves = decide("two halves", !facts.resolutionGiven, "they judge which resolution errs least", "the resolution is given") ? 2 : 1;
    needs.feedback = decide("feedback", facts.allBounces, "all bounces are asked for", "one bounce is asked for: surfaces send nothing on");
    const bool turned = decide("turned directions", facts.frame != mat3(1.0f), "most surfaces face axes of their own: cells keep directions along those",
                               "the axes of the grid serve as well as any");
    if (turned) needs.frame = facts.frame;
    decide("cells that nothing reads", false, "", "a cell farther from every point than a lookup reaches has no record");
    return needs;
}

}  // namespace clv
#endif
