//! Reference: registers, parameters, codes and telegrams, to look up.

mod diagram;
mod entry;
mod table;
mod topic;

use std::sync::{Arc, LazyLock};

use leptos::prelude::*;

use super::search::Search;
use super::state::{LearnState, Part};
use crate::address::{View, href};
use crate::components::button::Button;
use buslens::tool::link::Link;
use buslens::tool::reference::{About, Book, Chapter, Item, find, items};
use entry::Entry;
use table::Table;
use topic::TopicPage;

/// Everything that can be looked up.
static ITEMS: LazyLock<Vec<Arc<Item>>> = LazyLock::new(items);

/// What is looked at, as it stands in links: book, chapter, item, and what is typed.
#[derive(Clone, Debug, Default, PartialEq)]
struct Place {
    /// `None` for all of them.
    chapter: Option<(Book, Chapter)>,
    /// The key of what is open.
    item: String,
    typed: String,
}

impl Place {
    fn of(place: &str) -> Self {
        let mut parts = place.splitn(4, '.');
        let mut next = || parts.next().unwrap_or_default();
        let chapter = Book::of(next()).zip(Chapter::of(next()));
        Self { chapter, item: next().to_owned(), typed: next().to_owned() }
    }

    fn text(&self) -> String {
        let (book, chapter) = self.chapter.map_or(("", ""), |(book, chapter)| (book.key(), chapter.key()));
        let Self { item, typed, .. } = self;
        let place = format!("{book}.{chapter}.{item}.{typed}");
        if typed.is_empty() { place.trim_end_matches('.').to_owned() } else { place }
    }

    fn in_chapter(book: Book, chapter: Chapter) -> Self {
        Self { chapter: Some((book, chapter)), ..Self::default() }
    }

    /// The address of it.
    fn href(&self) -> String {
        href(
            View::Learn,
            &Link { place: format!("{}.{}", Part::Reference.key(), self.text()), ..Link::default() },
        )
    }

    /// What there is to choose from.
    fn found(&self) -> Vec<Arc<Item>> {
        let within =
            |item: &&Arc<Item>| self.chapter.is_none_or(|chapter| chapter == (item.book, item.chapter));
        match self.chapter {
            None => find(&ITEMS, &self.typed),
            Some(_) => find(&ITEMS.iter().filter(within).cloned().collect::<Vec<_>>(), &self.typed),
        }
    }

    /// What is open.
    fn open(&self) -> Option<Arc<Item>> {
        if self.item.is_empty() {
            return None;
        }
        let mut parts = self.item.split(':');
        let (book, chapter) = match self.chapter {
            Some(chapter) => chapter,
            None => (Book::of(parts.next()?)?, Chapter::of(parts.next()?)?),
        };
        let key = parts.next()?;
        let of = |item: &&Arc<Item>| (item.book, item.chapter) == (book, chapter);
        let mut all = ITEMS.iter().filter(of);
        let listed = all.find(|item| item.key == key).cloned();
        // Of a range, the address that was typed stands in the link.
        listed.or_else(|| {
            let within: Vec<Arc<Item>> = ITEMS.iter().filter(of).cloned().collect();
            find(&within, key).into_iter().find(|item| item.key == key)
        })
    }
}

/// The place of an item, with what was typed to find it.
fn place_of(item: &Item, typed: &str) -> Place {
    Place { chapter: Some((item.book, item.chapter)), item: item.key.clone(), typed: typed.to_owned() }
}

/// Whether it has a page of its own.
const fn is_topic(item: &Item) -> bool {
    matches!(item.about, About::Telegram(_))
}

/// What an item is about, in a few words.
fn about(item: &Item) -> String {
    match &item.about {
        About::Telegram(topic) if topic.code.is_empty() => topic.note.to_owned(),
        About::Telegram(topic) => format!("{}: {}", topic.code, topic.note),
        About::Register(register) => register.kind.clone(),
        About::Code(code) => code.of.clone(),
    }
}

#[component]
pub fn Reference() -> impl IntoView {
    let state = expect_context::<LearnState>();
    let place = Memo::new(move |_| Place::of(&state.place(Part::Reference)));
    let chapter = Memo::new(move |_| place.with(|place| place.chapter));
    let typed = Memo::new(move |_| place.with(|place| place.typed.clone()));
    let open = Memo::new(move |_| place.with(Place::open).map(ByKey));
    let found = Memo::new(move |_| {
        let (chapter, typed) = (chapter.get(), typed.get());
        Found(Place { chapter, typed, item: String::new() }.found())
    });
    let on_type = Callback::new(move |typed| {
        // What is open is no longer what is looked for.
        let to = Place { typed, item: String::new(), ..place.get_untracked() };
        state.type_to(Part::Reference, to.text());
    });
    // How far the search reaches, and what there is besides.
    let elsewhere = Memo::new(move |_| match (chapter.get(), typed.get()) {
        (Some(_), typed) if !typed.trim().is_empty() => {
            find(&ITEMS, &typed).len().saturating_sub(found.with(|found| found.0.len()))
        }
        _ => 0,
    });
    let everywhere = move |()| {
        let to = Place { typed: typed.get_untracked(), ..Place::default() };
        state.go_to(Part::Reference, to.text());
    };
    let topic = Memo::new(move |_| open.get().filter(|open| is_topic(&open.0)));
    let is_start = move || chapter.get().is_none() && typed.with(|typed| typed.trim().is_empty());
    let content = move || {
        if let Some(ByKey(item)) = topic.get() {
            return view! { <TopicPage item /> }.into_any();
        }
        if is_start() {
            return view! { <Start /> }.into_any();
        }
        let chosen = Signal::derive(move || open.get().map(|open| open.0));
        let on_choose = Callback::new(move |item: Arc<Item>| {
            let chapter = chapter.get_untracked();
            let to = place_of(&item, &typed.get_untracked());
            // A telegram has a page of its own; what else is found in all of it stays among what was found.
            let among = format!("{}:{}:{}", item.book.key(), item.chapter.key(), item.key);
            let to = match chapter {
                None if !is_topic(&item) => Place { chapter: None, item: among, ..to },
                _ => to,
            };
            state.go_to(Part::Reference, to.text());
        });
        let rows = Signal::derive(move || found.get().0);
        let with_book = chapter.get().is_none();
        let are_pages = chapter.get().is_some_and(|(_, chapter)| chapter == Chapter::Telegrams);
        view! {
            <div class="looked-up" class:pages=are_pages>
                <Table rows chosen with_book on_choose />
                {(!are_pages).then(|| view! { <Entry item=chosen /> })}
            </div>
        }
        .into_any()
    };
    let number = move || match found.with(|found| found.0.len()) {
        _ if is_start() => String::new(),
        1 => "1 entry".to_owned(),
        entries => format!("{entries} entries"),
    };
    view! {
        <section class="reference" aria-label="Reference">
            <Contents chapter />
            <div class="content">
                <div class="tools" role="search" aria-label="Reference">
                    <Search
                        label="Look up: a name, a number, a text of the display"
                        placeholder="A name or a number: set speed, 2034h, 40216, exception 66, E.bcc"
                        typed
                        on_type
                    />
                    <span class="end" role="status">
                        {move || number()}
                        <Button
                            class="link"
                            label=Signal::derive(move || format!("{} more in all of the reference", elsewhere.get()))
                            hidden=Signal::derive(move || elsewhere.get() == 0)
                            on_press=everywhere
                        />
                    </span>
                </div>
                {move || content()}
            </div>
        </section>
    }
}

/// What was found, the same as long as it is the same things.
#[derive(Clone)]
struct Found(Vec<Arc<Item>>);

impl PartialEq for Found {
    fn eq(&self, other: &Self) -> bool {
        self.0.len() == other.0.len()
            && self.0.iter().zip(&other.0).all(|(one, other)| Arc::ptr_eq(one, other))
    }
}

/// An item, the same as long as its key is.
#[derive(Clone)]
struct ByKey(Arc<Item>);

impl PartialEq for ByKey {
    fn eq(&self, other: &Self) -> bool {
        let key = |item: &Item| (item.book, item.chapter, item.key.clone());
        key(&self.0) == key(&other.0)
    }
}

/// The chapters, book by book.
#[component]
fn Contents(chapter: Memo<Option<(Book, Chapter)>>) -> impl IntoView {
    let of_book = |book: Book| {
        let link = |own: Chapter| {
            view! {
                <li>
                    <a
                        href=Place::in_chapter(book, own).href()
                        aria-current=move || (chapter.get() == Some((book, own))).then_some("true")
                    >
                        {own.label(book)}
                    </a>
                </li>
            }
        };
        view! {
            <li>
                <span class="book">{book.short()}</span>
                <ul>{book.chapters().map(link).into_iter().collect_view()}</ul>
            </li>
        }
    };
    view! {
        <nav class="contents" aria-label="Contents of the reference">
            <ul>
                <li>
                    <a href=Place::default().href() aria-current=move || chapter.get().is_none().then_some("true")>
                        "Everything"
                    </a>
                </li>
                {Book::all().into_iter().map(of_book).collect_view()}
            </ul>
        </nav>
    }
}

/// Where nobody looked for anything yet: what there is, and what can be typed.
#[component]
fn Start() -> impl IntoView {
    let of_book = |book: Book| {
        let chapter = |chapter: Chapter| {
            let all = ITEMS.iter().filter(|item| (item.book, item.chapter) == (book, chapter)).count();
            view! {
                <li>
                    <a href=Place::in_chapter(book, chapter).href()>{chapter.label(book)}</a>
                    <span class="number">{all}</span>
                </li>
            }
        };
        let source = match book {
            Book::Modbus => "Modbus application protocol V1.1b3",
            Book::Profibus => "EN 50170, volume 2",
            Book::Device(profile) => profile.source,
        };
        view! {
            <li>
                <h4>{book.label()}</h4>
                <p class="note">{source}</p>
                <ul>{book.chapters().map(chapter).into_iter().collect_view()}</ul>
            </li>
        }
    };
    let examples = [
        ("set speed", "a name, or a part of one"),
        ("Sy.52", "the short name that a maker gives it"),
        ("2034h", "an address, also as 0x2034, 8244 or 48245"),
        ("exception 66", "a code"),
        ("E.bcc", "what a display shows"),
        ("function 16", "a telegram"),
    ];
    let example = |(typed, about): (&str, &'static str)| {
        let place = Place { typed: typed.to_owned(), ..Place::default() };
        view! {
            <li>
                <a href=place.href()>
                    <code>{typed.to_owned()}</code>
                </a>
                <span class="soft">{about}</span>
            </li>
        }
    };
    view! {
        <div class="reference-start">
            <section aria-labelledby="what-can-be-typed">
                <h3 id="what-can-be-typed">"What can be typed above"</h3>
                <ul class="typed">{examples.map(example).into_iter().collect_view()}</ul>
            </section>
            <section aria-labelledby="what-there-is">
                <h3 id="what-there-is">"What there is"</h3>
                <ul class="books">{Book::all().into_iter().map(of_book).collect_view()}</ul>
            </section>
        </div>
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_leads_back() {
        for place in [
            "",
            "..modbus:codes:x.a.b",
            "modbus.telegrams.16",
            "keb-f5-modbus.registers..fb.05",
            "...set speed",
        ] {
            assert_eq!(Place::of(place).text(), place);
        }
        assert_eq!(Place::of("modbus.telegrams.16").open().unwrap().label, "Write multiple registers");
        assert_eq!(
            Place::of("keb-f5-modbus.registers.2050h").open().unwrap().label,
            "Inverter parameter 0050h"
        );
        assert!(Place::of("nothing.at.all").open().is_none());
        let among = Place::of("..memograph-rsg45:registers:215.channel 6");
        assert_eq!(among.open().unwrap().label, "Universal channel 6");
    }

    #[test]
    fn every_item_is_opened_by_its_place() {
        for item in ITEMS.iter() {
            let open = place_of(item, "").open().unwrap();
            assert_eq!((&open.label, &open.number), (&item.label, &item.number));
        }
    }
}
