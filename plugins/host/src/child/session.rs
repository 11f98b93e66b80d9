//! Host-side session of a plugin in a child.

use std::collections::BTreeMap;
use std::os::fd::{AsFd, BorrowedFd};
use std::sync::Arc;

use taceva_core::{
    ArgSpec, ArgValue, Args, Changer, Channels, Descriptor, DriverError, DriverKey, ErrorKind,
    FeatureShape, ForceTransducer, Found, Lighting, ModelError, Progress, Robot, Sensor,
    SilentProgress, SimulatedBench,
};

use super::array;
use super::bench::BenchProxy;
use super::error::{ChildError, plain_found};
use super::kind::Kind;
use super::link::Link;
use super::memory::SharedMemory;
use super::model::{ModelProxy, of_failure, of_link};
use super::plugin::arguments;
use super::socket::{LinkError, Socket};
use super::spec::ChildSpec;
use super::start::Child;
use super::wire::{Failure, ModelOrder, Order, OrderAnswer};
use crate::manifest::Manifest;
use crate::offer::Offer;
use crate::session::{FitRequest, Saved, SavedRegressor, Session};

/// Session in one child, for all devices of one plugin in one rig.
#[derive(Debug)]
pub struct ChildSession {
    child: Arc<Child>,
    plugin: DriverKey,
    arguments: BTreeMap<DriverKey, Vec<ArgSpec>>,
}

impl ChildSession {
    /// Starts a child for `plugin`. `arguments` contains the arguments that the manifest declares for drivers and estimators.
    ///
    /// # Errors
    /// As [`Child::start`].
    pub fn start(
        spec: ChildSpec,
        plugin: DriverKey,
        arguments: BTreeMap<DriverKey, Vec<ArgSpec>>,
    ) -> Result<ChildSession, ChildError> {
        Ok(ChildSession {
            child: Child::start(spec)?,
            plugin,
            arguments,
        })
    }

    /// Starts the child that [`ChildSpec::of_plugin`] specified, for the plugin with `manifest`.
    ///
    /// # Errors
    /// As [`Child::start`].
    pub fn of_plugin(spec: ChildSpec, manifest: &Manifest) -> Result<ChildSession, ChildError> {
        ChildSession::start(spec, manifest.id.as_driver(), arguments(manifest))
    }

    /// Child process of the session.
    pub fn child(&self) -> &Child {
        &self.child
    }

    fn open<K: Kind + ?Sized>(
        &self,
        driver: &DriverKey,
        args: &Args,
    ) -> Result<Box<K>, DriverError> {
        let kind = K::KIND;
        let doing = format!("open the {kind}");
        let no_socket = |error: rustix::io::Errno| {
            DriverError::new(ErrorKind::Internal, driver, doing.clone()).because(error)
        };
        let (calls, their_calls) = Socket::pair().map_err(no_socket)?;
        let (urgent, their_urgent) = Socket::pair().map_err(no_socket)?;
        let order = Order::Open {
            kind,
            driver: driver.clone(),
            args: self.pairs(driver, args),
        };
        let theirs = [their_calls.as_fd(), their_urgent.as_fd()];
        let answer = self.child.order(&order, &theirs, &doing);
        match answer.map_err(|error| error.of(driver, &doing))? {
            OrderAnswer::Opened { device } => {
                let link = Link::new(Arc::clone(&self.child), driver.clone(), calls, urgent);
                K::proxy(link, device)
            }
            OrderAnswer::Failed { failure } => Err(failure.to_error(driver)),
            _ => Err(self.other_answer(driver, &doing)),
        }
    }

    /// Arguments by name, restricted to those that the driver declares.
    fn pairs(&self, driver: &DriverKey, args: &Args) -> Vec<(String, ArgValue)> {
        let specs = self.arguments.get(driver).into_iter().flatten();
        specs
            .filter_map(|spec| Some((spec.key.clone(), args.get(&spec.key)?.clone())))
            .collect()
    }

    fn other_answer(&self, driver: &DriverKey, doing: &str) -> DriverError {
        let error = self.child.life().broke("an answer to another order");
        error.of(driver, doing)
    }
}

impl Session for ChildSession {
    fn offer(&self) -> Result<Offer, DriverError> {
        let doing = "list its offer";
        let answer = self.child.order(&Order::Offer {}, &[], doing);
        match answer.map_err(|error| error.of(&self.plugin, doing))? {
            OrderAnswer::Offered { offer } => Ok(offer),
            OrderAnswer::Failed { failure } => Err(failure.to_error(&self.plugin)),
            _ => Err(self.other_answer(&self.plugin, doing)),
        }
    }

    fn describe(&self, driver: &DriverKey, args: &Args) -> Result<Descriptor, DriverError> {
        let doing = "describe itself";
        let order = Order::Describe {
            driver: driver.clone(),
            args: self.pairs(driver, args),
        };
        let answer = self.child.order(&order, &[], doing);
        match answer.map_err(|error| error.of(driver, doing))? {
            OrderAnswer::Described { descriptor } if descriptor.key() == driver => Ok(descriptor),
            OrderAnswer::Failed { failure } => Err(failure.to_error(driver)),
            _ => Err(self.other_answer(driver, doing)),
        }
    }

    fn discover(&self, driver: &DriverKey) -> Result<Vec<Found>, DriverError> {
        let doing = "look for devices";
        let order = Order::Discover {
            driver: driver.clone(),
        };
        let answer = self.child.order(&order, &[], doing);
        match answer.map_err(|error| error.of(driver, doing))? {
            OrderAnswer::Found { found } if found.iter().all(|found| found.driver == *driver) => {
                Ok(found.into_iter().map(plain_found).collect())
            }
            OrderAnswer::Failed { failure } => Err(failure.to_error(driver)),
            _ => Err(self.other_answer(driver, doing)),
        }
    }

    fn sensor(&self, driver: &DriverKey, args: &Args) -> Result<Box<dyn Sensor>, DriverError> {
        self.open(driver, args)
    }

    fn robot(&self, driver: &DriverKey, args: &Args) -> Result<Box<dyn Robot>, DriverError> {
        self.open(driver, args)
    }

    fn force(
        &self,
        driver: &DriverKey,
        args: &Args,
    ) -> Result<Box<dyn ForceTransducer>, DriverError> {
        self.open(driver, args)
    }

    fn lighting(&self, driver: &DriverKey, args: &Args) -> Result<Box<dyn Lighting>, DriverError> {
        self.open(driver, args)
    }

    fn changer(&self, driver: &DriverKey, args: &Args) -> Result<Box<dyn Changer>, DriverError> {
        self.open(driver, args)
    }

    fn bench(&self, name: &str) -> Option<Arc<dyn SimulatedBench>> {
        let (calls, theirs) = Socket::pair().ok()?;
        let name = name.to_owned();
        let order = Order::Bench { name };
        match self
            .child
            .order(&order, &[theirs.as_fd()], "find its bench")
        {
            Ok(OrderAnswer::Bench { is_there: true }) => {
                let child = Arc::clone(&self.child);
                Some(Arc::new(BenchProxy::new(child, self.plugin.clone(), calls)))
            }
            _ => None,
        }
    }

    fn fit(
        &self,
        estimator: &DriverKey,
        request: &FitRequest<'_>,
    ) -> Result<Box<dyn SavedRegressor>, ModelError> {
        let failed = |failure: Failure| of_failure(estimator, &failure);
        let (training, memory) = array::share(request.training).map_err(failed)?;
        let validation = request.validation.map(array::share).transpose();
        let (validation, other_memory) = validation.map_err(failed)?.unzip();
        let order = ModelOrder::Fit {
            estimator: estimator.clone(),
            settings: self.pairs(estimator, request.settings),
            training,
            validation,
        };
        let memories: Vec<_> = [Some(&memory), other_memory.as_ref()]
            .into_iter()
            .flatten()
            .map(SharedMemory::file)
            .collect();
        let channels = request.training.targets.channels.clone();
        let shape = request.training.features.shape();
        self.make(
            estimator,
            order,
            &memories,
            channels,
            shape,
            request.progress,
        )
    }

    fn load(
        &self,
        estimator: &DriverKey,
        saved: &Saved<'_>,
    ) -> Result<Box<dyn SavedRegressor>, ModelError> {
        let mut memory = array::memory(Some(saved.bytes.len()))
            .map_err(|failure| of_failure(estimator, &failure))?;
        memory.bytes_mut()[..saved.bytes.len()].copy_from_slice(saved.bytes);
        let channels = saved.channels.clone();
        let order = ModelOrder::Load {
            estimator: estimator.clone(),
            channels: channels.clone(),
            shape: saved.shape,
            length: saved.bytes.len() as u64,
        };
        self.make(
            estimator,
            order,
            &[memory.file()],
            channels,
            saved.shape,
            &SilentProgress,
        )
    }
}

impl ChildSession {
    /// Sends the order for a model and waits until the child has made the model.
    fn make(
        &self,
        estimator: &DriverKey,
        order: ModelOrder,
        memories: &[BorrowedFd<'_>],
        channels: Channels,
        shape: FeatureShape,
        progress: &dyn Progress,
    ) -> Result<Box<dyn SavedRegressor>, ModelError> {
        let no_socket = |error: rustix::io::Errno| {
            let why = format!("{estimator}: cannot reach the plugin: {error}");
            ModelError::new(ErrorKind::Internal, why)
        };
        let (talk, theirs) = Socket::pair().map_err(no_socket)?;
        let files: Vec<_> = [&[theirs.as_fd()], memories].concat();
        let order = Order::Model { order };
        let answer = self.child.order(&order, &files, "make a model");
        drop(theirs);
        match answer {
            Ok(OrderAnswer::Making {}) => {
                let child = Arc::clone(&self.child);
                let made = ModelProxy::when_made(
                    child,
                    estimator.clone(),
                    talk,
                    channels,
                    shape,
                    progress,
                )?;
                Ok(Box::new(made))
            }
            Ok(OrderAnswer::Failed { failure }) => Err(of_failure(estimator, &failure)),
            Ok(_) => {
                let error = LinkError::Breach("an answer to another order".to_owned());
                Err(of_link(&self.child, estimator, error))
            }
            Err(error) => {
                let why = format!("{estimator}: {error}");
                Err(ModelError::new(error.kind(), why).because(error))
            }
        }
    }
}
