//! Drivers and estimators that a plugin provides.

use taceva_core::{
    Builtin, Changer, DescriptorError, Factory, ForceTransducer, Lighting, Robot, Sensor,
};

use crate::estimator::EstimatorFactory;

/// Driver or estimator of a plugin, as its factory or as a function that makes the factory.
///
/// [`export_plugin!`](crate::export_plugin) creates drivers from its arguments.
///
/// ```
/// # use taceva_core::{Args, Axes, Deadline, Descriptor, DescriptorError, DescriptorSpec, DriverError, DriverKey, DriverSource, Factory};
/// # use taceva_core::{Facts, ForceFacts, ForceTransducer, Rig, Stamp, Wrench};
/// # struct Scale(Descriptor);
/// # impl Factory<dyn ForceTransducer> for Scale {
/// #     fn descriptor(&self) -> &Descriptor { &self.0 }
/// #     fn open(&self, _: &Args, _: &mut Rig) -> Result<Box<dyn ForceTransducer>, DriverError> { unreachable!("nothing is opened") }
/// # }
/// fn make() -> Result<Box<dyn Factory<dyn ForceTransducer>>, DescriptorError> {
///     let facts = Facts::Force(ForceFacts::default().with_axes(Axes::NORMAL));
///     let key = DriverKey::fixed("org.example.scale/scale");
///     Ok(Box::new(Scale(DescriptorSpec::new(key, "a scale", DriverSource::Real, facts).check()?)))
/// }
/// use taceva_plugin::{Driver, Provide};
/// assert!(matches!(<dyn ForceTransducer>::provide(make), Driver::Force(_)));
/// ```
#[non_exhaustive]
pub enum Driver {
    /// Driver of a sensor.
    Sensor(Builtin<dyn Sensor>),
    /// Driver of a robot.
    Robot(Builtin<dyn Robot>),
    /// Driver of a force transducer.
    Force(Builtin<dyn ForceTransducer>),
    /// Driver of a lighting device.
    Lighting(Builtin<dyn Lighting>),
    /// Driver of a changer.
    Changer(Builtin<dyn Changer>),
    /// An estimator.
    Estimator(MakeEstimator),
    /// Factory that was created at run time.
    Made(Made),
}

/// Factory of a driver or an estimator that is created at run time, such as a driver described in another language.
///
/// ```
/// # use taceva_core::{Args, Axes, Descriptor, DescriptorSpec, DriverError, DriverKey, DriverSource, Factory, Facts, ForceFacts};
/// # use taceva_core::{ForceTransducer, Rig};
/// # struct Scale(Descriptor);
/// # impl Factory<dyn ForceTransducer> for Scale {
/// #     fn descriptor(&self) -> &Descriptor { &self.0 }
/// #     fn open(&self, _: &Args, _: &mut Rig) -> Result<Box<dyn ForceTransducer>, DriverError> { unreachable!("nothing is opened") }
/// # }
/// use taceva_plugin::{Driver, Made};
/// let facts = Facts::Force(ForceFacts::default().with_axes(Axes::NORMAL));
/// let key = DriverKey::fixed("org.example.scale/scale");
/// let scale = Scale(DescriptorSpec::new(key, "a scale", DriverSource::Real, facts).check()?);
/// assert!(matches!(Driver::Made(Made::Force(Box::new(scale))), Driver::Made(_)));
/// # Ok::<(), taceva_core::DescriptorError>(())
/// ```
#[non_exhaustive]
pub enum Made {
    /// Factory of a sensor.
    Sensor(Box<dyn Factory<dyn Sensor>>),
    /// Factory of a robot.
    Robot(Box<dyn Factory<dyn Robot>>),
    /// Factory of a force transducer.
    Force(Box<dyn Factory<dyn ForceTransducer>>),
    /// Factory of a lighting device.
    Lighting(Box<dyn Factory<dyn Lighting>>),
    /// Factory of a changer.
    Changer(Box<dyn Factory<dyn Changer>>),
    /// Factory of an estimator.
    Estimator(Box<dyn EstimatorFactory>),
}

/// Function that makes the factory of an estimator.
///
/// ```
/// # use taceva_core::{DriverKey, ModelError, Saved, SavedRegressor};
/// # use taceva_plugin::{EstimatorFactory, FitRequest};
/// struct Mean(DriverKey);
/// impl EstimatorFactory for Mean {
///     fn key(&self) -> &DriverKey { &self.0 }
///     fn title(&self) -> &str { "the mean of the labels" }
/// #   fn fit(&self, _: &FitRequest<'_>) -> Result<Box<dyn SavedRegressor>, ModelError> { unreachable!("nothing is fitted") }
/// #   fn load(&self, _: &Saved<'_>) -> Result<Box<dyn SavedRegressor>, ModelError> { unreachable!("nothing is loaded") }
///     // `fit` and `load` besides.
/// }
/// use taceva_plugin::MakeEstimator;
/// let make: MakeEstimator = || Box::new(Mean(DriverKey::fixed("org.example.mean/mean")));
/// assert_eq!(make().title(), "the mean of the labels");
/// ```
pub type MakeEstimator = fn() -> Box<dyn EstimatorFactory>;

/// Kind of driver or estimator, such as `dyn Sensor`, which [`export_plugin!`](crate::export_plugin) accepts.
///
/// ```
/// # use taceva_core::{Args, Axes, Deadline, Descriptor, DescriptorError, DescriptorSpec, DriverError, DriverKey, DriverSource, Factory};
/// # use taceva_core::{Facts, ForceFacts, ForceTransducer, Rig, Stamp, Wrench};
/// # struct Scale(Descriptor);
/// # impl Factory<dyn ForceTransducer> for Scale {
/// #     fn descriptor(&self) -> &Descriptor { &self.0 }
/// #     fn open(&self, _: &Args, _: &mut Rig) -> Result<Box<dyn ForceTransducer>, DriverError> { unreachable!("nothing is opened") }
/// # }
/// fn make() -> Result<Box<dyn Factory<dyn ForceTransducer>>, DescriptorError> {
///     let facts = Facts::Force(ForceFacts::default().with_axes(Axes::NORMAL));
///     let key = DriverKey::fixed("org.example.scale/scale");
///     Ok(Box::new(Scale(DescriptorSpec::new(key, "a scale", DriverSource::Real, facts).check()?)))
/// }
/// use taceva_plugin::{Driver, Provide};
/// let drivers: Vec<Driver> = vec![<dyn ForceTransducer>::provide(make)];
/// assert_eq!(drivers.len(), 1);
/// ```
pub trait Provide {
    /// Function that makes the factory.
    type Make;

    /// Creates the driver from the function that makes its factory.
    fn provide(make: Self::Make) -> Driver;
}

/// Function that makes the factory of a device driver.
///
/// ```
/// # use taceva_core::{Args, Axes, Deadline, Descriptor, DescriptorError, DescriptorSpec, DriverError, DriverKey, DriverSource, Factory};
/// # use taceva_core::{Facts, ForceFacts, ForceTransducer, Rig, Stamp, Wrench};
/// # struct Scale(Descriptor);
/// # impl Factory<dyn ForceTransducer> for Scale {
/// #     fn descriptor(&self) -> &Descriptor { &self.0 }
/// #     fn open(&self, _: &Args, _: &mut Rig) -> Result<Box<dyn ForceTransducer>, DriverError> { unreachable!("nothing is opened") }
/// # }
/// fn make() -> Result<Box<dyn Factory<dyn ForceTransducer>>, DescriptorError> {
///     let facts = Facts::Force(ForceFacts::default().with_axes(Axes::NORMAL));
///     let key = DriverKey::fixed("org.example.scale/scale");
///     Ok(Box::new(Scale(DescriptorSpec::new(key, "a scale", DriverSource::Real, facts).check()?)))
/// }
/// use taceva_plugin::MakeFactory;
/// let make: MakeFactory<dyn ForceTransducer> = make;
/// assert_eq!(make()?.descriptor().title(), "a scale");
/// # Ok::<(), DescriptorError>(())
/// ```
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

impl Provide for dyn Changer {
    type Make = MakeFactory<dyn Changer>;
    fn provide(make: Self::Make) -> Driver {
        Driver::Changer(Builtin::new(make))
    }
}

impl Provide for dyn EstimatorFactory {
    type Make = MakeEstimator;
    fn provide(make: Self::Make) -> Driver {
        Driver::Estimator(make)
    }
}
