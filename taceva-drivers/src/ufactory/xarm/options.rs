//! Options for opening an arm, parsed from the arguments of the driver.

use taceva_core::{ArgValue, Args, Millimetre, Point, Speed, Workspace};
use thiserror::Error;

use crate::arguments::network::port_of;
use crate::arguments::robot::speed_max;
use crate::text::shown;

/// Address of the controller and limits of the arm.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct XarmOptions {
    pub(super) host: String,
    pub(super) port: u16,
    pub(super) pose_port: u16,
    pub(super) status_port: u16,
    pub(super) rich_port: u16,
    pub(super) speed_max: Speed,
    pub(super) acceleration_mm_s2: f64,
    pub(super) workspace: Option<Workspace>,
}

/// Error for an argument that the declaration accepts but that is invalid.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub(super) enum OptionsError {
    #[error("`workspace`: `{}`, expected six numbers in mm with commas, smallest x, y, z and then largest: `200,-100,150,400,100,350`", shown(.text))]
    Workspace { text: String },
    #[error("`speed_max_mm_s`: expected a speed above 0 mm/s")]
    Speed,
}

impl XarmOptions {
    /// Reads the options from `args`, which the driver's declaration has checked.
    pub(super) fn read(args: &Args) -> Result<XarmOptions, OptionsError> {
        let workspace = match args.get("workspace").and_then(ArgValue::as_text) {
            None => None,
            Some(text) => Some(workspace(text).ok_or_else(|| OptionsError::Workspace {
                text: text.to_owned(),
            })?),
        };
        Ok(XarmOptions {
            host: args.text("host").to_owned(),
            port: port_of(args, "port"),
            pose_port: port_of(args, "pose_port"),
            status_port: port_of(args, "status_port"),
            rich_port: port_of(args, "rich_port"),
            speed_max: speed_max(args).map_err(|_| OptionsError::Speed)?,
            acceleration_mm_s2: args.number("acceleration_mm_s2"),
            workspace,
        })
    }
}

/// Parses the workspace `x,y,z,x,y,z` in mm: smallest corner, then largest. Returns `None` if the text is invalid.
fn workspace(text: &str) -> Option<Workspace> {
    let numbers: Option<Vec<f64>> = text
        .split(',')
        .map(|number| {
            number
                .trim()
                .parse()
                .ok()
                .filter(|number: &f64| number.is_finite())
        })
        .collect();
    let &[x0, y0, z0, x1, y1, z1] = &numbers?[..] else {
        return None;
    };
    let corner = |[x, y, z]: [f64; 3]| Point {
        x: Millimetre(x),
        y: Millimetre(y),
        z: Millimetre(z),
    };
    (x0 < x1 && y0 < y1 && z0 < z1).then(|| Workspace {
        least: corner([x0, y0, z0]),
        greatest: corner([x1, y1, z1]),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_workspace_is_six_numbers_in_order() {
        let found = workspace("200, -100,150,400,100,350").expect("a box");
        assert_eq!(found.least.y, Millimetre(-100.0));
        assert_eq!(found.greatest.z, Millimetre(350.0));
        for text in [
            "",
            "1,2,3",
            "1,2,3,4,5,6,7",
            "4,5,6,1,2,3",
            "0,0,0,1,1,NaN",
            "0,0,0,1,1,inf",
            "a,b,c,d,e,f",
        ] {
            assert!(workspace(text).is_none(), "{text}");
        }
    }
}
