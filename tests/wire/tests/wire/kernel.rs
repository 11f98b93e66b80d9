//! Drivers on devices of a real kernel, in a virtual machine: HID devices by `uhid`, a camera by `vivid`.
//!
//! A test boots the machine, in which this program runs again and carries out the test of the same subject that is ignored here. The time of
//! such a machine says nothing; what is proved is what drivers and kernel say to each other.

mod archive;
mod hid;
mod machine;
mod modules;
mod v4l2;
