// Merges sums of integers into a history of still light.
#include "clv/data/frame.h"
#include "clv/stages/merge.h"
#include "fixed_sums.hlsli"
#include "still_weight.hlsli"
#include "merge.hlsli"
