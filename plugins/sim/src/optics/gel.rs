//! Gel in front of the camera.

use super::band::Band;
use super::error::OpticsError;
use super::gelsight::Gelsight;
use super::magictac::Magictac;
use super::raster::Raster;
use super::spec::GelSpec;
use super::view::View;
use super::vitactip::Vitactip;
use crate::random::Random;

/// One unit of a gel at one frame size.
#[derive(Clone, Debug)]
pub(super) enum Gel {
    Gelsight(Box<Gelsight>),
    Magictac(Box<Magictac>),
    Vitactip(Box<Vitactip>),
}

impl Gel {
    pub(super) fn new(spec: &GelSpec, raster: Raster, unit: u32) -> Gel {
        match spec {
            GelSpec::Gelsight(spec) => Gel::Gelsight(Box::new(Gelsight::new(spec, raster, unit))),
            GelSpec::Magictac(spec) => Gel::Magictac(Box::new(Magictac::new(spec, raster, unit))),
            GelSpec::Vitactip(spec) => Gel::Vitactip(Box::new(Vitactip::new(spec, raster, unit))),
        }
    }

    /// Sets the view of a frame. `random` determines random effects in the gel.
    pub(super) fn pose(&mut self, view: &View, random: &Random) -> Result<(), OpticsError> {
        match self {
            Gel::Gelsight(gel) => gel.pose(view),
            Gel::Magictac(gel) => gel.pose(view, random),
            Gel::Vitactip(gel) => gel.pose(view),
        }
    }

    /// Renders some rows of the current view.
    #[inline(always)]
    pub(super) fn paint(&self, band: &mut Band<'_>) {
        match self {
            Gel::Gelsight(gel) => gel.paint(band),
            Gel::Magictac(gel) => gel.paint(band),
            Gel::Vitactip(gel) => gel.paint(band),
        }
    }
}
