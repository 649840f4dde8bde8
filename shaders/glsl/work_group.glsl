// Which item a thread of a work group works on.
layout(local_size_x = CLV_GROUP_SIZE) in;

uint itemNumber() { return clvItem(gl_GlobalInvocationID); }
