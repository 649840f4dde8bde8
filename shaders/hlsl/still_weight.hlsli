// The weight of this frame in a history of still light: one for all slots.
float mergeWeight(uint i, uint vectors, float weight) { return weight; }
