/* SPDX-License-Identifier: MIT */
#include "app/base/sandbox_message.h"

#include <errno.h>
#include <string.h>
#include <sys/socket.h>

typedef union ancillary {
    struct cmsghdr header; /* for the alignment */
    char bytes[CMSG_SPACE(sizeof(int))];
} ancillary;

bool message_send(int socket, message_kind kind, const char *text, int descriptor) {
    message m = { .kind = (unsigned char)kind };
    ancillary control = { .bytes = { 0 } };
    const size_t length = strnlen(text, sizeof m.text - 1);
    memcpy(m.text, text, length);
    struct iovec part = { &m, offsetof(message, text) + length };
    struct msghdr header = { .msg_iov = &part, .msg_iovlen = 1 };
    if (descriptor >= 0) {
        header.msg_control = control.bytes;
        header.msg_controllen = sizeof control.bytes;
        struct cmsghdr *const item = CMSG_FIRSTHDR(&header);
        item->cmsg_level = SOL_SOCKET;
        item->cmsg_type = SCM_RIGHTS;
        item->cmsg_len = CMSG_LEN(sizeof descriptor);
        memcpy(CMSG_DATA(item), &descriptor, sizeof descriptor);
    }
    return sendmsg(socket, &header, MSG_NOSIGNAL | MSG_DONTWAIT) >= 0;
}

bool message_receive(int socket, bool wait, message *m, int *descriptor) {
    ancillary control = { .bytes = { 0 } };
    struct iovec part = { m, sizeof *m - 1 };
    struct msghdr header = { .msg_iov = &part, .msg_iovlen = 1 };
    if (descriptor) {
        *descriptor = -1;
        header.msg_control = control.bytes;
        header.msg_controllen = sizeof control.bytes;
    }
    ssize_t got;
    do
        got = recvmsg(socket, &header, MSG_CMSG_CLOEXEC | (wait ? 0 : MSG_DONTWAIT));
    while (got < 0 && errno == EINTR);
    if (got <= 0)
        return false;
    ((char *)m)[got] = 0;
    const struct cmsghdr *const item = descriptor ? CMSG_FIRSTHDR(&header) : NULL;
    if (item && item->cmsg_type == SCM_RIGHTS)
        memcpy(descriptor, CMSG_DATA(item), sizeof *descriptor);
    return true;
}
