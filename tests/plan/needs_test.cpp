// What a scene needs follows from its facts, one decision each, with a reason.
#include <algorithm>

#include <gtest/gtest.h>

#include "clv/plan/needs.h"

namespace clv {
namespace {

const Decision& decisionOn(const Needs& needs, const std::string& name) {
    const auto found = std::ranges::find(needs.decisions, name, &Decision::name);
    EXPECT_NE(found, needs.decisions.end()) << name;
    return *found;
}

TEST(Needs, oneChannelServesOnlyWhereLightsAndSurfacesAreGrey) {
    for (bool lights : {false, true}) {
        for (bool surfaces : {false, true}) {
            SceneFacts facts;
            facts.greyLights = lights;
            facts.greySurfaces = surfaces;
            const Needs needs = planNeeds(facts);
            EXPECT_EQ(needs.channels, lights && surfaces ? 1 : 3);
            EXPECT_EQ(decisionOn(needs, "colour").needed, needs.channels == 3);
        }
    }
}

TEST(Needs, aSceneWithoutLightNeedsNothing) {
    SceneFacts facts;
    facts.anyLight = false;
    facts.allBounces = true;
    const Needs needs = planNeeds(facts);
    EXPECT_FALSE(needs.stages);
    ASSERT_EQ(needs.decisions.size(), 1u);
    EXPECT_FALSE(needs.decisions[0].needed);
}

TEST(Needs, directionsAreTurnedOnlyWhereTheSceneHasAxesOfItsOwn) {
    SceneFacts facts;
    EXPECT_FALSE(decisionOn(planNeeds(facts), "turned directions").needed);
    EXPECT_EQ(planNeeds(facts).frame, mat3(1.0f));
    facts.frame = mat3(vec3(0.6f, 0.8f, 0.0f), vec3(-0.8f, 0.6f, 0.0f), vec3(0.0f, 0.0f, 1.0f));
    EXPECT_TRUE(decisionOn(planNeeds(facts), "turned directions").needed);
    EXPECT_EQ(planNeeds(facts).frame, facts.frame);
}

TEST(Needs, aStillSceneNeedsNoDynamicityNoScrollingAndOneCascade) {
    SceneFacts facts;
    facts.cascadesInBounds = 4;
    const Needs needs = planNeeds(facts);
    EXPECT_FALSE(needs.dynamicity);
    EXPECT_FALSE(needs.scrolling);
    EXPECT_EQ(needs.cascades, 1);
}

TEST(Needs, movingLightsBringDynamicity) {
    SceneFacts facts;
    facts.lightsMove = true;
    const Needs needs = planNeeds(facts);
    EXPECT_TRUE(needs.dynamicity);
    EXPECT_FALSE(needs.scrolling);
}

TEST(Needs, aMovingCameraBringsScrollingAndTheCascadesThatAddSpace) {
    SceneFacts facts;
    facts.cameraMoves = true;
    EXPECT_TRUE(planNeeds(facts).scrolling);
    EXPECT_EQ(planNeeds(facts).cascades, 1);
    facts.cascadesInBounds = 3;
    EXPECT_EQ(planNeeds(facts).cascades, 3);
    EXPECT_TRUE(decisionOn(planNeeds(facts), "further cascades").needed);
}

TEST(Needs, halvesAndFeedbackFollowWhatIsAskedFor) {
    SceneFacts facts;
    EXPECT_EQ(planNeeds(facts).halves, 2);
    EXPECT_FALSE(planNeeds(facts).feedback);
    facts.resolutionGiven = facts.allBounces = true;
    EXPECT_EQ(planNeeds(facts).halves, 1);
    EXPECT_TRUE(planNeeds(facts).feedback);
}

TEST(Needs, everyDecisionHasAReasonAndANameOfItsOwn) {
    SceneFacts everything;
    everything.lightsMove = everything.cameraMoves = everything.allBounces = true;
    everything.cascadesInBounds = 2;
    for (const SceneFacts& facts : {SceneFacts{}, everything}) {
        const Needs needs = planNeeds(facts);
        std::vector<std::string> names;
        for (const Decision& d : needs.decisions) {
            EXPECT_FALSE(d.reason.empty()) << d.name;
            names.push_back(d.name);
        }
        std::ranges::sort(names);
        EXPECT_EQ(std::ranges::adjacent_find(names), names.end());
    }
}

}  // namespace
}  // namespace clv
