// Cells of the view: the k-th of n layers begins at this share of the reach. Near layers are thin.
float layerStart(float k, float n) { return k / n * k / n; }
float layerOf(float share, float n) { return n * sqrt(share); }
