//! Arguments, checked by the host against what the manifest declares.

use crate::text::Text;

/// `taceva_arg`: one argument.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Arg {
    /// Its name.
    pub key: Text,
    /// Its value as text, whatever its type.
    pub text: Text,
    /// Of a whole number; 0 or 1 for a flag.
    pub whole: i64,
    /// Of a number, in the unit that the manifest declares.
    pub number: f64,
    /// [`Arg::TEXT`], [`Arg::WHOLE`], [`Arg::NUMBER`] or [`Arg::FLAG`].
    pub kind: u32,
    /// 0.
    pub reserved: u32,
}

impl Arg {
    /// A text, a path or one of some choices.
    pub const TEXT: u32 = 1;
    /// A whole number.
    pub const WHOLE: u32 = 2;
    /// A number.
    pub const NUMBER: u32 = 3;
    /// On or off.
    pub const FLAG: u32 = 4;
}

/// `taceva_args`: all arguments.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Args {
    /// The first; may be NULL only where `count` is 0.
    pub items: *const Arg,
    /// How many.
    pub count: usize,
}
