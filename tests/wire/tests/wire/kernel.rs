//! Tests of drivers with a real kernel in a virtual machine. The kernel emulates HID devices (`uhid`) and a camera (`vivid`).
//!
//! A test boots the machine, in which this program runs again with the ignored test of the same subject. Times in such a machine are not meaningful.
//! Only the communication between drivers and kernel is tested.

mod archive;
mod hid;
mod machine;
mod modules;
mod v4l2;
