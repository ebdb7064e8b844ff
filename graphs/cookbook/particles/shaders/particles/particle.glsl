struct Particle {
  vec3 position;  // world
  float age;      // seconds; below 0: not born yet
  vec3 velocity;  // world units per second
  float life;     // seconds; 0: never lived
};
