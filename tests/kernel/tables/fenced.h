/* fenced.h - memory of exactly the length asked for: what reads or writes beyond its end falls at once, in a build without ASan, too. */
#ifndef FENCED_H
#define FENCED_H

#include <stdint.h>

/* Room for n things of `size` bytes, all zero; aborts where there is no memory.  Any thread may take and leave it. */
void *fenced_room(int64_t n, int64_t size);
void fenced_leave(void *room);

#endif
