// Merges sums of integers into a history of moving light.
#include "clv/data/frame.h"
#include "clv/stages/merge.h"
#include "fixed_sums.hlsli"
#include "moving_weight.hlsli"
#include "merge.hlsli"
