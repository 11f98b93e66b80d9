//! Drivers on devices of a real kernel, in a virtual machine: HID devices by `uhid`, a camera by `vivid`.
//!
//! A test boots the machine. In it this program runs again with the ignored test of the same subject. Times in such a machine mean nothing;
//! only the communication between drivers and kernel is tested.

mod archive;
mod hid;
mod machine;
mod modules;
mod v4l2;
