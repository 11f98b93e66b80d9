//! Main loop of a child: opens devices and serves each on its own threads.

mod device;

use std::os::fd::OwnedFd;
use std::sync::Arc;

use taceva_core::{Args, DriverError, DriverKey, DriverKind, ErrorKind};

use self::device::Opening;
use super::arguments::arguments;
use super::socket::{LinkError, Socket};
use super::thread::guarded;
use super::wire::{Failure, OpenedDevice, Order, OrderAnswer};
use super::{bench, model};
use crate::session::Session;

/// Answers orders until the host is gone or sends the order to end. Without a session, the function returns on the first order.
pub(super) fn serve(mut orders: Socket, session: Option<&Arc<dyn Session>>) {
    // Any failure to receive means that the host is gone.
    while let Ok(((sequence, order), files)) = orders.receive_with_files::<(u32, Order)>() {
        let answer = match (order, session) {
            (Order::Shutdown {}, _) | (_, None) => return,
            (order, Some(session)) => obey(order, files, session),
        };
        let answer = answer.unwrap_or_else(|failure| OrderAnswer::Failed { failure });
        if send_or_say_why(&mut orders, sequence, answer).is_err() {
            return;
        }
    }
}

/// Sends an answer. If the answer is too long, sends a failure instead.
fn send_or_say_why(
    orders: &mut Socket,
    sequence: u32,
    answer: OrderAnswer,
) -> Result<(), LinkError> {
    match orders.send(&(sequence, answer), &[]) {
        Err(LinkError::Unsendable(why)) => {
            let failure = Failure::new(ErrorKind::Protocol, "answer", &why);
            let answer = OrderAnswer::Failed { failure };
            orders.send(&(sequence, answer), &[])
        }
        sent => sent,
    }
}

fn obey(
    order: Order,
    files: Vec<OwnedFd>,
    session: &Arc<dyn Session>,
) -> Result<OrderAnswer, Failure> {
    match order {
        Order::Open { kind, driver, args } => {
            let [calls, urgent] = <[OwnedFd; 2]>::try_from(files)
                .map_err(|_| broken("an open order needs two sockets"))?;
            let opening = Opening { calls, urgent };
            let device = open(&**session, kind, &driver, &arguments(&args)?, opening)?;
            Ok(OrderAnswer::Opened { device })
        }
        Order::Describe { driver, args } => {
            let args = arguments(&args)?;
            let descriptor = called("describe itself", || session.describe(&driver, &args))?;
            Ok(OrderAnswer::Described { descriptor })
        }
        Order::Discover { driver } => {
            let found = called("look for devices", || session.discover(&driver))?;
            Ok(OrderAnswer::Found { found })
        }
        Order::Bench { name } => {
            let bench = guarded("find its bench", || session.bench(&name))?;
            let is_there = bench.is_some();
            if let Some((bench, calls)) = bench.zip(files.into_iter().next()) {
                bench::serve(bench, calls)?;
            }
            Ok(OrderAnswer::Bench { is_there })
        }
        Order::Offer {} => {
            let offer = called("list its offer", || session.offer())?;
            Ok(OrderAnswer::Offered { offer })
        }
        Order::Model { order } => {
            model::serve(Arc::clone(session), order, files)?;
            Ok(OrderAnswer::Making {})
        }
        Order::Shutdown {} => Err(broken("a shutdown order that expects an answer")),
    }
}

fn open(
    session: &dyn Session,
    kind: DriverKind,
    driver: &DriverKey,
    args: &Args,
    opening: Opening,
) -> Result<OpenedDevice, Failure> {
    match kind {
        DriverKind::Sensor => opening.serve(|| session.sensor(driver, args)),
        DriverKind::Robot => opening.serve(|| session.robot(driver, args)),
        DriverKind::Force => opening.serve(|| session.force(driver, args)),
        DriverKind::Lighting => opening.serve(|| session.lighting(driver, args)),
        DriverKind::Changer => opening.serve(|| session.changer(driver, args)),
        _ => {
            let why = format!("unknown kind of device {kind}");
            Err(Failure::new(
                ErrorKind::Unsupported,
                "open the device",
                &why,
            ))
        }
    }
}

/// Calls the session and converts a panic into a failure.
fn called<T>(doing: &str, call: impl FnOnce() -> Result<T, DriverError>) -> Result<T, Failure> {
    guarded(doing, call)?.map_err(|error| Failure::of(&error))
}

fn broken(expected: &str) -> Failure {
    Failure::new(
        ErrorKind::Protocol,
        "read an order",
        &format!("expected {expected}"),
    )
}
