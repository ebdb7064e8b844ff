// A surface in the list of its pixel.
struct Node { uint before, color, glow, depth; };  // before: number of the next in the list, from 1 on; 0: none
