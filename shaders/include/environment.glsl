// The surroundings as a cube map of linear light, world directions.
#include "include/shared.h"

layout(binding = RELIEF_TEXTURE_ENVIRONMENT) uniform samplerCube environment;
