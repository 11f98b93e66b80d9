//! Handlers of the paths of the server.

use std::io::{self, Write};
use std::net::TcpStream;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use serde::Deserialize;
use taceva_protocol::Answer;

use crate::access::Access;
use crate::live::Shared;
use crate::request::{self, Request};
use crate::response::{self, Status};
use crate::strangers::Stranger;

/// Maximum number of streams, enough for two pages.
const STREAMS_MAX: usize = 4;
/// Interval at which the state of the page is sent.
const EVENTS: Duration = Duration::from_millis(100);
/// Interval at which a stream without pictures checks for the end of the page.
const LOOK: Duration = Duration::from_millis(250);
/// Timeout for sending a picture or an event to a browser.
const TAKING: Duration = Duration::from_secs(5);
/// Multipart boundary between two pictures.
const BOUNDARY: &str = "taceva-picture";
/// Name of the header with the predictions, in the multipart head of a picture.
const PREDICTION: &str = "X-Taceva-Prediction";

/// State shared by all connections.
pub(crate) struct Site {
    pub(crate) access: Access,
    pub(crate) shared: Arc<Shared>,
    pub(crate) on_stop: Box<dyn Fn() + Send + Sync>,
}

/// Serves one connection: one request, one response. A stream requires the token, so its connection no longer counts as a `stranger`.
pub(crate) fn serve(mut stream: TcpStream, stranger: Stranger, site: &Site) -> io::Result<()> {
    let done = request::read(&mut stream).and_then(|request| {
        site.access.check_origin(&request)?;
        route(&request, site)
    });
    match done {
        Err(status) => {
            response::bare(&mut stream, status)?;
            request::drain(stream)
        }
        Ok(Reply::Bare(status)) => response::bare(&mut stream, status),
        Ok(Reply::File(kind, body)) => {
            response::whole(&mut stream, Status::Ok, kind, body.as_bytes())
        }
        Ok(Reply::Frames(_viewer)) => {
            drop(stranger);
            frames(&mut stream, &site.shared)
        }
        Ok(Reply::Events(_viewer)) => {
            drop(stranger);
            events(&mut stream, &site.shared)
        }
    }
}

/// Response to a request.
enum Reply {
    Bare(Status),
    File(&'static str, &'static str),
    Frames(Viewer),
    Events(Viewer),
}

const HTML: &str = include_str!("page/page.html");
const STYLE: &str = include_str!("page/page.css");
const SCRIPT: &str = include_str!("page/page.js");

fn route(request: &Request, site: &Site) -> Result<Reply, Status> {
    let path = request.path.split('?').next().unwrap_or_default();
    let method = request.method.as_str();
    let file = match path {
        "/" => Some(("text/html; charset=utf-8", HTML)),
        "/page.css" => Some(("text/css; charset=utf-8", STYLE)),
        "/page.js" => Some(("text/javascript; charset=utf-8", SCRIPT)),
        _ => None,
    };
    if let Some((kind, text)) = file {
        return match method {
            "GET" => Ok(Reply::File(kind, text)),
            _ => Err(Status::WrongMethod),
        };
    }
    if path == "/favicon.ico" {
        // Browsers request the icon on their own, without the token.
        return Ok(Reply::Bare(Status::NoContent));
    }
    site.access.check_token(request)?;
    match (path, method) {
        ("/frames", "GET") => Ok(Reply::Frames(Viewer::enter(&site.shared)?)),
        ("/events", "GET") => Ok(Reply::Events(Viewer::enter(&site.shared)?)),
        ("/stop", "POST") => {
            // The first action, because the robot must stop.
            (site.on_stop)();
            site.shared.stop();
            Ok(Reply::Bare(Status::NoContent))
        }
        ("/answer", "POST") => answer(&request.body, &site.shared).map(Reply::Bare),
        ("/frames" | "/events" | "/stop" | "/answer", _) => Err(Status::WrongMethod),
        _ => Err(Status::NotFound),
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Given {
    question: u64,
    answer: Word,
}

#[derive(Deserialize)]
#[serde(rename_all = "lowercase")]
enum Word {
    Done,
    Skip,
    Stop,
}

fn answer(body: &[u8], shared: &Shared) -> Result<Status, Status> {
    let given: Given = serde_json::from_slice(body).map_err(|_| Status::BadRequest)?;
    let answer = match given.answer {
        Word::Done => Answer::Done,
        Word::Skip => Answer::Skip,
        Word::Stop => Answer::Stop,
    };
    match shared.give_answer(given.question, answer) {
        true => Ok(Status::NoContent),
        false => Err(Status::Conflict),
    }
}

/// Open stream, counted until drop.
struct Viewer(Arc<Shared>);

impl Viewer {
    fn enter(shared: &Arc<Shared>) -> Result<Viewer, Status> {
        match entered(&shared.viewers, STREAMS_MAX) {
            true => Ok(Viewer(Arc::clone(shared))),
            false => Err(Status::Busy),
        }
    }
}

impl Drop for Viewer {
    fn drop(&mut self) {
        self.0.viewers.fetch_sub(1, Ordering::AcqRel);
    }
}

/// Increments `count` and returns true, unless `count` is already `most`.
fn entered(count: &AtomicUsize, most: usize) -> bool {
    let more = |count: usize| (count < most).then_some(count + 1);
    count
        .fetch_update(Ordering::AcqRel, Ordering::Acquire, more)
        .is_ok()
}

/// Sends pictures as they are encoded. Skips pictures if the browser is too slow.
fn frames(stream: &mut TcpStream, shared: &Shared) -> io::Result<()> {
    response::stream(
        stream,
        &format!("multipart/x-mixed-replace; boundary={BOUNDARY}"),
    )?;
    let mut last = 0;
    while !shared.is_over.load(Ordering::Acquire) {
        let Some(picture) = shared.frames.next(last, LOOK) else {
            // Detects a closed browser although there is nothing new to show.
            put(stream, b"\r\n")?;
            continue;
        };
        last = picture.number;
        let predicted = picture
            .overlay
            .as_ref()
            .map_or_else(String::new, |overlay| {
                format!("{PREDICTION}: {}\r\n", overlay.header())
            });
        let head = format!(
            "--{BOUNDARY}\r\nContent-Type: image/jpeg\r\nContent-Length: {}\r\n{predicted}\r\n",
            picture.jpeg.len()
        );
        put(stream, &[head.as_bytes(), &picture.jpeg, b"\r\n"].concat())?;
        if let Some(overlay) = &picture.overlay {
            shared.sent(picture.number, overlay);
        }
    }
    Ok(())
}

/// Sends the state ten times a second, and the places of presses at each change.
fn events(stream: &mut TcpStream, shared: &Shared) -> io::Result<()> {
    response::stream(stream, "text/event-stream")?;
    let mut version = None;
    loop {
        let is_last = shared.is_over.load(Ordering::Acquire);
        let places = shared.places_json(&mut version);
        let places = places.map_or_else(String::new, |json| {
            format!("event: places\ndata: {json}\n\n")
        });
        let state = shared.state_json();
        let event = format!("{places}event: state\ndata: {state}\n\n");
        put(stream, event.as_bytes())?;
        if is_last {
            return Ok(());
        }
        std::thread::sleep(EVENTS);
    }
}

/// Writes all of `bytes`, or fails after the timeout.
fn put(stream: &mut TcpStream, bytes: &[u8]) -> io::Result<()> {
    let began = Instant::now();
    let mut left = bytes;
    while !left.is_empty() {
        if began.elapsed() > TAKING {
            return Err(io::ErrorKind::TimedOut.into());
        }
        match stream.write(left) {
            Ok(0) => return Err(io::ErrorKind::WriteZero.into()),
            Ok(count) => left = &left[count..],
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Err(error) => return Err(error),
        }
    }
    Ok(())
}
