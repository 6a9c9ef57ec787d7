# Formulas of the documents, $...$ and $$...$$, as Doxygen writes them.
s/^\$\$/\\f[/
s/\$\$$/\\f]/
s/\$/\\f$/g
