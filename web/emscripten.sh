# SPDX-License-Identifier: MIT
# For Debian's Emscripten, where node and Python come from elsewhere: its packages for node, and Debian's Python, which
# starts in half the time of a version manager's.
export NODE_PATH=/usr/share/nodejs EMSDK_PYTHON=/usr/bin/python3
