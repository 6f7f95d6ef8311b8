//! The page's address: behind its `#` stand the view and what it shows, so that a link, a reload, and
//! back and forward bring both back. No server sees that part.

use std::rc::Rc;

use gloo_timers::callback::Timeout;
use leptos::prelude::*;
use leptos::task::spawn_local;
use wasm_bindgen::JsValue;
use web_sys::js_sys::{decode_uri_component, encode_uri_component};

use crate::browser::compression::{self, Refusal};
use crate::browser::storage;
use buslens::tool::link::Link;
use buslens::tool::{Options, Settings};

/// Longer ones are compressed.
const LONGEST_PLAIN: usize = 400;
/// Mail programs and chats cut or refuse longer ones.
const LONGEST: usize = 30_000;
/// What is longer is not kept for the next visit: browsers allow a few megabytes in all.
const LONGEST_KEPT: usize = 2_000_000;
/// Stands before what is compressed, in base64url.
const COMPRESSED: &str = "z=";

/// The entry of a link that names a file, which only this browser has.
pub const FILE: &str = "file";

/// The views of the page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum View {
    Read,
    Build,
    Check,
    Devices,
    Learn,
    /// What is read, made for paper.
    Sheet,
}

impl View {
    pub const ALL: [Self; 6] =
        [Self::Read, Self::Build, Self::Check, Self::Devices, Self::Learn, Self::Sheet];

    /// What it is called in addresses, and in the browser's store.
    pub fn key(self) -> &'static str {
        match self {
            Self::Read => "read",
            Self::Build => "build",
            Self::Check => "check",
            Self::Devices => "devices",
            Self::Learn => "learn",
            Self::Sheet => "sheet",
        }
    }

    pub fn label(self) -> &'static str {
        match self {
            Self::Read => "Read",
            Self::Build => "Build",
            Self::Check => "Check",
            Self::Devices => "Devices",
            Self::Learn => "Learn",
            Self::Sheet => "Sheet",
        }
    }

    /// The view whose content it shows.
    fn content(self) -> Self {
        match self {
            Self::Sheet => Self::Read,
            view => view,
        }
    }

    fn of(key: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|view| view.key() == key)
    }
}

/// The address of a view that shows `link`.
pub fn href(view: View, link: &Link) -> String {
    match written(link) {
        content if content.is_empty() => format!("#/{}", view.key()),
        content => format!("#/{}?{content}", view.key()),
    }
}

/// Why there is no link to what is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoLink {
    /// Nothing is shown.
    Nothing,
    /// A file is open, which is on this machine only.
    File,
    TooLong,
}

impl NoLink {
    pub const fn sentence(self) -> &'static str {
        match self {
            Self::Nothing => "There is nothing to link to yet.",
            Self::File => {
                "A file is too long for a link: send the file itself, or paste only the lines that matter and copy \
                 a link to those."
            }
            Self::TooLong => {
                "This is too long for a link, even compressed: mail programs and chats cut links of more than 30,000 \
                 characters. Send it as a file."
            }
        }
    }
}

/// Who knows what the views show.
pub trait Shows {
    /// What `view` shows at this moment.
    fn link(&self, view: View) -> Link;
    /// `view` shows something else.
    fn follow(&self, view: View, link: Link);
    /// A link cannot be followed.
    fn refuse(&self, why: &str);
}

/// What to do with the address that there was.
#[derive(Clone, Copy, PartialEq)]
enum Step {
    /// Somebody goes on typing: "back" leads to where he began.
    Typed,
    /// Somebody chose something else: "back" undoes that.
    Chosen,
}

/// The address, as handed to every part of the page.
#[derive(Clone, Copy)]
pub struct Address {
    view: RwSignal<View>,
    keeper: StoredValue<Keeper, LocalStorage>,
}

struct Keeper {
    shows: Option<Rc<dyn Shows>>,
    /// What stands in the address.
    written: String,
    step: Step,
    waiting: Option<Timeout>,
    /// What stands in the history, and what was typed there when somebody went on before it was written.
    left: Vec<(String, String)>,
    /// The views that were shown already, and so have what they show.
    visited: Vec<View>,
}

impl Address {
    pub fn new() -> Self {
        let keeper = Keeper {
            shows: None,
            written: String::new(),
            step: Step::Typed,
            waiting: None,
            left: Vec::new(),
            visited: Vec::new(),
        };
        Self { view: RwSignal::new(split(&here()).0), keeper: StoredValue::new_local(keeper) }
    }

    /// The view that is shown.
    pub fn view(&self) -> View {
        self.view.get()
    }

    /// The same, for handlers.
    pub fn view_now(&self) -> View {
        self.view.get_untracked()
    }

    /// Somebody typed: the address follows at the next pause, and "back" leads to before the typing.
    pub fn typed(&self) {
        self.renew(Step::Typed);
    }

    /// Somebody chose something else: "back" undoes that.
    pub fn chosen(&self) {
        self.renew(Step::Chosen);
    }

    /// Goes to another view, which goes on showing what it did.
    pub fn go_to(&self, view: View) {
        let _ = window().location().set_hash(&format!("/{}", view.key()));
    }

    /// The whole address of what is shown, where it fits into a link.
    pub async fn link(&self) -> Result<String, NoLink> {
        let view = self.view.get_untracked();
        let link = self.shows().ok_or(NoLink::Nothing)?.link(view);
        if link.entries.iter().any(|(path, _)| path == FILE) {
            return Err(NoLink::File);
        }
        let content = written(&link);
        if content.is_empty() {
            return Err(NoLink::Nothing);
        }
        let address = window().location().href().unwrap_or_default();
        let address = address.split('#').next().unwrap_or_default().to_owned();
        let content = packed(content).await.ok_or(NoLink::TooLong)?;
        Ok(format!("{address}#/{}?{content}", view.key()))
    }

    /// Brings back what the address says, or what was shown at the last visit. From now on the address
    /// follows what is shown, and what is shown the address.
    pub fn keep(self, shows: Rc<dyn Shows>) {
        self.keeper.update_value(|keeper| keeper.shows = Some(shows));
        spawn_local(self.follow());
        // Comes for links within the page, too.
        let popped = window_event_listener(leptos::ev::popstate, move |_| spawn_local(self.follow()));
        let hidden = window_event_listener_untyped("pagehide", move |_| spawn_local(self.write()));
        on_cleanup(move || {
            popped.remove();
            hidden.remove();
        });
    }

    fn shows(&self) -> Option<Rc<dyn Shows>> {
        self.keeper.with_value(|keeper| keeper.shows.clone())
    }

    /// Shows what the address says.
    async fn follow(self) {
        let fragment = here();
        let (view, content) = split(&fragment);
        let Some(shows) = self.shows() else { return };
        // What was to be written is of before, whose place in the history cannot be changed any more.
        let before = self.view.get_untracked();
        if self.keeper.with_value(|keeper| keeper.waiting.is_some()) {
            let typed = shows.link(before);
            self.keeper.update_value(|keeper| {
                let place = keeper.written.clone();
                keeper.left.retain(|(left, _)| *left != place);
                keeper.left.push((place, written(&typed)));
            });
            let _ = storage::keep(before.content().key(), &kept_text(typed).unwrap_or_default());
        }
        let first = self.keeper.try_update_value(|keeper| {
            keeper.waiting = None;
            keeper.step = Step::Typed;
            keeper.written.clone_from(&fragment);
            let first = !keeper.visited.contains(&view.content());
            if first {
                keeper.visited.push(view.content());
            }
            first
        });
        let typed = self.keeper.try_update_value(|keeper| {
            let at = keeper.left.iter().position(|(left, _)| *left == fragment)?;
            Some(keeper.left.swap_remove(at).1)
        });
        if let Some(typed) = typed.flatten() {
            if first == Some(true) || typed != written(&shows.link(view)) {
                shows.follow(view, read(&typed));
            }
            self.view.set(view);
            return self.write().await;
        }
        let key = view.content().key();
        let kept_here = (first == Some(true)).then(|| storage::kept_for_reload(key)).flatten();
        if content.is_empty() {
            if first == Some(true) {
                let kept = kept_here.or_else(|| storage::kept(key)).unwrap_or_default();
                shows.follow(view, read(&kept));
            }
            self.view.set(view);
            return self.write().await;
        }
        let plain = match content.strip_prefix(COMPRESSED) {
            _ if content.len() > LONGEST => Err(Refusal::Damaged),
            Some(packed) => compression::unpacked(packed).await,
            None => Ok(content.to_owned()),
        };
        match plain {
            // Back to a view that still shows it.
            Ok(plain) if first == Some(false) && plain == written(&shows.link(view)) => {}
            Ok(plain) => shows.follow(view, read(&plain)),
            Err(Refusal::Damaged) => shows.refuse("This link is damaged or incomplete and cannot be opened."),
            Err(Refusal::TooMuch) => {
                shows.refuse("This link holds more than a link of Buslens ever does: it is not followed.");
            }
        }
        self.view.set(view);
    }

    /// What is shown is something else: the address follows at the next pause. Browsers refuse pages
    /// that change theirs at every keystroke.
    fn renew(self, step: Step) {
        const PAUSE: u32 = 400;
        self.keeper.update_value(|keeper| {
            if step == Step::Chosen {
                keeper.step = step;
            }
            // What waited before is dropped, and so never done.
            keeper.waiting = Some(Timeout::new(PAUSE, move || spawn_local(self.write())));
        });
    }

    /// Keeps what every view shows, since the page is about to be loaded anew; whether all of it comes back.
    pub async fn keep_all(self) -> bool {
        let Some(shows) = self.shows() else { return true };
        let visited = self.keeper.with_value(|keeper| keeper.visited.clone());
        let kept = visited.into_iter().all(|view| {
            let kept = kept_text(shows.link(view));
            kept.is_some_and(|kept| storage::keep_for_reload(view.key(), &kept).is_ok())
        });
        self.keeper.update_value(|keeper| keeper.waiting = None);
        self.write().await;
        kept
    }

    /// Writes what is shown into the address, and into the browser's store for the next visit.
    async fn write(self) {
        let Some(shows) = self.shows() else { return };
        let view = self.view.get_untracked();
        let link = shows.link(view);
        let content = written(&link);
        // A full or forbidden store only means that it is gone at the next visit; Devices, whose settings
        // must not get lost, says so.
        let _ = storage::keep(view.content().key(), &kept_text(link).unwrap_or_default());
        let content = packed(content).await.unwrap_or_default();
        let fragment = match content.is_empty() {
            true => format!("/{}", view.key()),
            false => format!("/{}?{content}", view.key()),
        };
        self.keeper.update_value(|keeper| {
            let step = std::mem::replace(&mut keeper.step, Step::Typed);
            if keeper.written == fragment {
                return;
            }
            let address = format!("#{fragment}");
            // A browser that refuses it leaves the address as it was.
            let _ = window().history().and_then(|history| match step {
                Step::Chosen => history.push_state_with_url(&JsValue::NULL, "", Some(&address)),
                Step::Typed => history.replace_state_with_url(&JsValue::NULL, "", Some(&address)),
            });
            keeper.written = fragment;
        });
    }
}

/// View and content of what stands behind the `#`. What does not begin with a view is of the time when
/// views were documents: it is for Read.
fn split(fragment: &str) -> (View, &str) {
    let Some(rest) = fragment.strip_prefix('/') else { return (View::Read, fragment) };
    let (key, content) = rest.split_once('?').unwrap_or((rest, ""));
    (View::of(key).unwrap_or(View::Read), content)
}

/// What a link holds, as it stands in an address.
fn written(link: &Link) -> String {
    let encoded = |text: &str| String::from(encode_uri_component(text)).replace("%20", "+");
    let pairs: Vec<String> =
        link.pairs().iter().map(|(key, value)| format!("{}={}", encoded(key), encoded(value))).collect();
    pairs.join("&")
}

/// What a link holds, as it is kept for the next visit, if it is not too long for that.
fn kept_text(link: Link) -> Option<String> {
    // How devices are set up is kept by itself, and may be changed before the next visit.
    let options = Options { settings: Settings::default(), ..link.options };
    Some(written(&Link { options, ..link })).filter(|kept| kept.len() <= LONGEST_KEPT)
}

/// The link that [`written`] wrote; what is damaged is left out.
fn read(content: &str) -> Link {
    let decoded = |text: &str| decode_uri_component(&text.replace('+', " ")).ok().map(String::from);
    Link::read(content.split('&').filter_map(|pair| {
        let (key, value) = pair.split_once('=')?;
        Some((decoded(key)?, decoded(value)?))
    }))
}

fn here() -> String {
    let hash = window().location().hash().unwrap_or_default();
    hash.strip_prefix('#').unwrap_or_default().to_owned()
}

/// Content as short as it gets; `None` if that is still too long.
async fn packed(content: String) -> Option<String> {
    if content.len() <= LONGEST_PLAIN {
        return Some(content);
    }
    let text = compression::packed(content).await?;
    (text.len() + COMPRESSED.len() <= LONGEST).then(|| format!("{COMPRESSED}{text}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fragment_names_a_view_and_its_content() {
        assert_eq!(split("/build?text=01"), (View::Build, "text=01"));
        assert_eq!(split("/check"), (View::Check, ""));
        assert_eq!(split(""), (View::Read, ""));
        assert_eq!(split("/nowhere?x"), (View::Read, "x"));
        assert_eq!(split("text=01+03&device=x"), (View::Read, "text=01+03&device=x"));
    }
}
