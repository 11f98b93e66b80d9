//! Network port arguments.

use taceva_core::{ArgSpec, ArgValue, Args};

/// Argument `key` for a network port; its default is `usual`.
pub(crate) fn port(key: &str, usual: i64, help: &str) -> ArgSpec {
    ArgSpec::whole(key, 1, 65_535)
        .default(ArgValue::Whole(usual))
        .help(help)
}

/// Port number from an argument of [`port`].
pub(crate) fn port_of(args: &Args, key: &str) -> u16 {
    // The range was checked before.
    u16::try_from(args.whole(key)).unwrap_or(0)
}
