/* SPDX-License-Identifier: MIT */
/* sandbox_message.h - messages between the sandbox's child and its parent, over a pair of sockets
 * that keep messages apart. */
#ifndef LAMPION_BASE_SANDBOX_MESSAGE_H
#define LAMPION_BASE_SANDBOX_MESSAGE_H

#include "app/base/error.h"

typedef enum message_kind {
    MESSAGE_OPEN,     /* from the child: open the file of this name */
    MESSAGE_FILE,     /* from the parent: the file, as a descriptor */
    MESSAGE_PROGRESS, /* from the child: this much of the work is done */
    MESSAGE_FAILURE   /* from either: what went wrong */
} message_kind;

typedef struct message {
    unsigned char kind;
    char text[sizeof((base_error *)0)->text];
} message;

/* Sends a message without waiting for the other side to make room. A descriptor may go with it; -1:
 * none. */
bool message_send(int socket, message_kind kind, const char *text, int descriptor);

/* Receives a message, waiting for one if `wait`; returns false if there is none. *descriptor is -1
 * if none came with it; one is taken only where there is room for it. */
bool message_receive(int socket, bool wait, message *m, int *descriptor);

#endif
