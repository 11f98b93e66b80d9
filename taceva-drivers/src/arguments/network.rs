//! Where a device is on a network.

use taceva_core::{ArgSpec, ArgValue, Args};

/// A port of a network, `usual` where nobody says otherwise.
pub(crate) fn port(key: &str, usual: i64, help: &str) -> ArgSpec {
    ArgSpec::whole(key, 1, 65_535)
        .default(ArgValue::Whole(usual))
        .help(help)
}

/// The port that an argument of [`port`] gives.
pub(crate) fn port_of(args: &Args, key: &str) -> u16 {
    // Its range was checked.
    u16::try_from(args.whole(key)).unwrap_or(0)
}
