//! What a plugin is made of.

use taceva_core::{Builtin, DescriptorError, Factory, ForceTransducer, Lighting, Robot, Sensor};

use crate::estimator::EstimatorFactory;

/// A driver or an estimator that a plugin provides: how its factory is made.
///
/// [`export_plugin!`](crate::export_plugin) makes these from the lines that it is given.
#[non_exhaustive]
pub enum Driver {
    /// A sensor.
    Sensor(Builtin<dyn Sensor>),
    /// A robot.
    Robot(Builtin<dyn Robot>),
    /// A force transducer.
    Force(Builtin<dyn ForceTransducer>),
    /// A lighting.
    Lighting(Builtin<dyn Lighting>),
    /// An estimator.
    Estimator(MakeEstimator),
}

/// Makes the factory of an estimator.
pub type MakeEstimator = fn() -> Box<dyn EstimatorFactory>;

/// A kind of thing that a plugin can provide, as [`export_plugin!`](crate::export_plugin) names it: `dyn Sensor` for one.
pub trait Provide {
    /// What makes its factory.
    type Make;

    /// The driver whose factory `make` makes.
    fn provide(make: Self::Make) -> Driver;
}

/// Makes the factory of a driver of devices.
pub type MakeFactory<D> = fn() -> Result<Box<dyn Factory<D>>, DescriptorError>;

impl Provide for dyn Sensor {
    type Make = MakeFactory<dyn Sensor>;
    fn provide(make: Self::Make) -> Driver {
        Driver::Sensor(Builtin::new(make))
    }
}

impl Provide for dyn Robot {
    type Make = MakeFactory<dyn Robot>;
    fn provide(make: Self::Make) -> Driver {
        Driver::Robot(Builtin::new(make))
    }
}

impl Provide for dyn ForceTransducer {
    type Make = MakeFactory<dyn ForceTransducer>;
    fn provide(make: Self::Make) -> Driver {
        Driver::Force(Builtin::new(make))
    }
}

impl Provide for dyn Lighting {
    type Make = MakeFactory<dyn Lighting>;
    fn provide(make: Self::Make) -> Driver {
        Driver::Lighting(Builtin::new(make))
    }
}

impl Provide for dyn EstimatorFactory {
    type Make = MakeEstimator;
    fn provide(make: Self::Make) -> Driver {
        Driver::Estimator(make)
    }
}
