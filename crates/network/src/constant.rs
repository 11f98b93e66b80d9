//! Numbers of the running program as constants of the compiler.

/// `$call` with `$number` as the constant `$constant`: compiled once for each of `$known`, so that what it counts lies in registers.
macro_rules! with_constant {
    ($constant:ident = $number:expr, one of [$($known:literal),+] => $call:expr) => {
        match $number {
            $($known => {
                const $constant: usize = $known;
                $call
            })+
            _ => unreachable!("beyond what was compiled"),
        }
    };
}

pub(crate) use with_constant;
