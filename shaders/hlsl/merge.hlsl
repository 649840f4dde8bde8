// Merges sums of floats into a history of still light.
#include "clv/data/frame.h"
#include "clv/stages/merge.h"
#include "float_sums.hlsli"
#include "still_weight.hlsli"
#include "merge.hlsli"
