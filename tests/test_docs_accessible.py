"""What of the documentation's pages scrolls can be reached and has a name."""

import sys
from pathlib import Path

sys.path.append(str(Path(__file__).parent.parent / "docs"))

from accessible import accessible, accessible_page, accessible_tree

BODY = """<h1>Files<a class="headerlink" href="#files">#</a></h1><pre>text</pre>
<div class="table-wrapper colwidths-auto docutils container"><table class="docutils"></table></div>
<h2>Keys &amp; <code>values</code></h2><div class="math"><math></math></div>
<div class="table-wrapper docutils container"><table class="docutils"></table></div><div class="mathematics"></div>
<table><tr></tr></table>"""


def test_what_scrolls_is_a_region_with_a_name_of_its_own():
    made = accessible(BODY)
    region = 'tabindex="0" role="region" aria-label='
    assert f'container" {region}"Table 1: Files"><table class="docutils">' in made
    assert f'{region}"Table 2: Keys &amp; values"' in made
    assert f'<div class="math" {region}"Formula 1: Keys &amp; values">' in made
    assert '<pre tabindex="0">text' in made and '<table tabindex="0"><tr>' in made and made.count("region") == 3


def test_captions_have_a_level_and_asides_a_name():
    assert accessible_tree('<p class="caption" role="heading"><span>') == (
        '<p class="caption" role="heading" aria-level="2"><span>')
    page = accessible_page('<aside class="sidebar-drawer"></aside><aside class="toc-drawer no-toc"></aside>')
    assert page == ('<aside aria-label="All pages" class="sidebar-drawer"></aside>'
                    '<aside aria-label="On this page" class="toc-drawer no-toc"></aside>')


def test_a_long_signature_is_no_list_and_the_search_has_a_heading():
    signature = '<dt id="f">f(<dl>\n<dd><em>a</em>: <a href="#b">B</a>,</dd><dd><em>c</em>,</dd></dl>\n)</dt>'
    fields = '<dl class="field"><dt>Raises</dt><dd>ValueError</dd></dl>'
    made = accessible(signature + fields)
    assert made == ('<dt id="f">f(<div><div class="parameter"><em>a</em>: <a href="#b">B</a>,</div>'
                    f'<div class="parameter"><em>c</em>,</div></div>\n)</dt>{fields}')
    assert accessible_page('<main><div id="search-results"></div>') == (
        '<main><h1>Search</h1>\n<div id="search-results"></div>')


def test_numbers_stay_with_their_units_but_in_code():
    made = accessible('<p title="5 mm">\u00b110 % of <code>2 m</code> <b>279 \u00b5m</b></p><pre>3 s</pre>')
    assert made == ('<p title="5 mm">\u00b1<span class="unbroken">10 %</span> of <code>2 m</code> '
                    '<b><span class="unbroken">279 \u00b5m</span></b></p><pre tabindex="0">3 s</pre>')
