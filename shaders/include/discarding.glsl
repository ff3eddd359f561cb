// Discards fragments, so that derivatives remain defined where they are still to be asked for. To be
// included after what shades.

// A discarded fragment leaves its neighbours' derivatives undefined: on a GPU one pixel in a hundred of
// a mirror of sprites was strange. So where the environment is looked up, a fragment is shaded first.
#ifdef RELIEF_ENVIRONMENT_ASKS_NEIGHBOURS
bool is_lost = false;
// The condition first: it may correct the position, which the neighbours ask for.
#define RELIEF_DISCARD_IF(condition) is_lost = (condition) || is_lost
#define RELIEF_DISCARD_LOST if (is_lost) discard
#else
#define RELIEF_DISCARD_IF(condition) if (condition) discard
#define RELIEF_DISCARD_LOST
#endif
