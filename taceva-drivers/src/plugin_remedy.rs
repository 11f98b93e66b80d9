//! Remedy for the error of a device whose plugin ended.

use taceva_core::DriverError;

/// Remedy for an `error` of a device whose plugin crashed, hung or exited. `None` for other errors, whose cause may be the device or its cable.
pub fn plugin_remedy(error: &DriverError) -> Option<String> {
    let plugin = ended_plugin(error)?;
    Some(format!(
        "find the fault of the plugin with `taceva plugin check {plugin}`, then let it start again with `taceva plugin release {plugin}`"
    ))
}

/// Name of the plugin whose process ended by its own fault and caused `error`.
#[cfg(all(feature = "plugin", target_os = "linux"))]
fn ended_plugin(error: &DriverError) -> Option<&str> {
    use std::error::Error;
    use taceva_host::ChildError;

    let causes = std::iter::successors(error.source(), |&cause| cause.source());
    let mut ended = causes.filter_map(|cause| cause.downcast_ref::<ChildError>());
    match ended.next()? {
        ChildError::Gone { plugin, fate, .. } if fate.is_its_own_fault() => Some(plugin),
        _ => None,
    }
}

#[cfg(not(all(feature = "plugin", target_os = "linux")))]
fn ended_plugin(_: &DriverError) -> Option<&str> {
    None
}

#[cfg(all(test, feature = "plugin", target_os = "linux"))]
mod tests {
    use taceva_core::{DriverKey, ErrorKind};
    use taceva_host::{ChildError, Fate};

    use super::*;

    const DRIVER: DriverKey = DriverKey::fixed("org.example.x/scale");

    #[test]
    fn a_crash_names_the_commands_for_its_plugin_and_other_errors_name_none() {
        let of = |fate| {
            let plugin = "org.example.x".to_owned();
            let printed = String::new();
            let gone = ChildError::Gone {
                plugin,
                fate,
                printed,
            };
            gone.of(&DRIVER, "read the force")
        };
        for fate in [Fate::Signalled { signal: 11 }, Fate::Exited { code: 3 }] {
            let remedy = plugin_remedy(&of(fate)).expect("its own fault");
            for command in ["check", "release"] {
                let command = format!("`taceva plugin {command} org.example.x`");
                assert!(remedy.contains(&command), "{remedy}");
            }
        }
        assert_eq!(plugin_remedy(&of(Fate::Signalled { signal: 9 })), None);
        let unplugged = DriverError::new(ErrorKind::Disconnected, &DRIVER, "read the force");
        assert_eq!(plugin_remedy(&unplugged), None);
        assert_eq!(plugin_remedy(&unplugged.because("no answer")), None);
    }
}
